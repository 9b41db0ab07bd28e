// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_shear_stress_cap_h
#define talus_base_shear_stress_cap_h

#include <talus/base/expression.h>

#include <deal.II/base/point.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace talus
{
  /// Maximum shear stress between a surface and the soil, Pa, given by the user
  /// as a number or an expression in position and `depth`, the depth of the
  /// position below the initial mudline, m.
  template <int dim>
  class ShearStressCap
  {
  public:
    /// Depth below the initial mudline, m; 0 without soil above at the start.
    using Depth = std::function<double(const dealii::Point<dim> &)>;

    /// Parse @p words, the value of the parameter @p path. Throws ExcUser if
    /// @p words is invalid.
    ShearStressCap(const std::string &path,
                   const std::string &words,
                   const Constants   &constants);

    /// Return the value, Pa, if it is a constant number.
    const std::optional<double> &
    number() const
    {
      return number_;
    }

    /// Whether set_depth() must be called before at().
    bool
    depends_on_depth() const
    {
      return depends_on_depth_;
    }

    void
    set_depth(const Depth &depth)
    {
      depth_ = depth;
    }

    /// Return the maximum shear stress at @p x, Pa. Throws ExcUser if it is
    /// negative, ExcPoint if it is not finite.
    double
    at(const dealii::Point<dim> &x) const;

  private:
    double
    checked(double value, const std::string &place) const;

    std::string                      path_, words_;
    bool                             depends_on_depth_;
    std::optional<double>            number_;
    std::unique_ptr<Expression<dim>> expression_; ///< null for a number
    Depth                            depth_;
  };
} // namespace talus

#endif

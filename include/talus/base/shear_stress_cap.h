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
  /// The largest shear stress that a surface passes to the soil, as the user
  /// gives it: a number, or an expression in the place and `depth`, which is how
  /// far the place lies below the mudline of the start.
  template <int dim>
  class ShearStressCap
  {
  public:
    /// Depth below the mudline at the start, m; 0 where there was no soil above.
    using Depth = std::function<double(const dealii::Point<dim> &)>;

    /// @p path of the parameter, for messages. Throws ExcUser if @p words cannot
    /// be understood.
    ShearStressCap(const std::string &path,
                   const std::string &words,
                   const Constants   &constants);

    /// The number, Pa, if it is one.
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

    /// At @p x, Pa. Throws ExcUser if it is negative, ExcPoint if it is not
    /// finite.
    double
    at(const dealii::Point<dim> &x) const;

  private:
    double
    checked(double value, const std::string &place) const;

    std::string                      path_, words_;
    bool                             depends_on_depth_;
    std::optional<double>            number_;
    std::unique_ptr<Expression<dim>> expression_; ///< unless it is a number
    Depth                            depth_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_expression_surface_h
#define talus_geometry_expression_surface_h

#include <talus/geometry/place_expression.h>

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace talus
{
  /// Surface given by an expression in x (and z) and the heights of named
  /// surfaces: "mudline - 5".
  template <int dim>
  class ExpressionSurface : public Surface<dim>
  {
  public:
    using typename Surface<dim>::Value;
    using typename Surface<dim>::Named;

    /// Throws ExcUser if the expression is not valid.
    /// @param path name of the parameter, for messages
    /// @param known surfaces that the expression may name
    ExpressionSurface(const std::string        &path,
                      const std::string        &expression,
                      const Constants          &constants,
                      const std::vector<Named> &known);

    Value
    at(const dealii::Point<dim> &x) const override;

    double
    height(const dealii::Point<dim> &x) const override;

    bool
    is_known_at(const dealii::Point<dim> &x) const override;

    /// Estimate from the heights at some surrounding places, times 1.5.
    double
    largest_change(const dealii::Point<dim> &x, double distance) const override;

  private:
    Value
    compute_value(const dealii::Point<dim> &x) const;
    double
    compute_largest_change(const dealii::Point<dim> &x, double distance) const;

    /// Result with the numbers that the result depends on.
    template <std::size_t n, typename T>
    struct Known
    {
      std::array<double, n> key = {{std::numeric_limits<double>::quiet_NaN()}};
      T                     result{};
    };

    /// Recent results, each at the place given by the hash of its key: a newer
    /// result replaces an older result.
    template <std::size_t n, typename T>
    using Table = std::vector<Known<n, T>>;

    /// Expression in x (and z) and the heights of the surfaces.
    PlaceExpression<dim>     expression_;
    mutable Table<2, Value>  values_;  ///< by place in plan
    mutable Table<3, double> changes_; ///< by place in plan and distance
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_place_expression_h
#define talus_geometry_place_expression_h

#include <talus/base/expression.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/point.h>

#include <boost/container/small_vector.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace talus
{
  /// Quantity given by the user for each place: a number, or an expression in
  /// coordinates of the place and the named surfaces, perhaps also in `depth`,
  /// the depth of the place below the initial mudline, m, and in `overburden`,
  /// Pa. The name of a surface
  /// is the height, or the number of the raster, in the vertical of the place.
  template <int dim>
  class PlaceExpression
  {
  public:
    using Named = typename Surface<dim>::Named;

    /// Variables beside the surfaces, in the order of the arguments.
    enum class Variables
    {
      plan,            ///< x (and z)
      space,           ///< x, y (and z)
      space_and_depth, ///< x, y (and z), depth
      space_depth_and_overburden
    };

    /// Variables in their order, then the surfaces.
    using Arguments = boost::container::small_vector<double, 8>;

    /// Depth below the initial mudline, m; 0 without soil above at the start.
    using Depth = std::function<double(const dealii::Point<dim> &)>;

    /// Parse @p words, the value of the parameter @p path. Throws ExcUser if
    /// @p words is invalid.
    /// @param known surfaces that @p words may name
    PlaceExpression(const std::string        &path,
                    const std::string        &words,
                    const Constants          &constants,
                    const std::vector<Named> &known,
                    Variables variables = Variables::space_and_depth);

    /// Return the value if it is a constant number.
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

    /// Surfaces in the expression, in the order of the arguments.
    const std::vector<Named> &
    surfaces() const
    {
      return surfaces_;
    }

    /// Return the value at @p x, m. Throws ExcUser where a surface is
    /// undefined, ExcPoint if the value is not finite.
    /// @param overburden weight of the soil above, Pa
    double
    at(const dealii::Point<dim> &x, double overburden = 0.) const;

    /// Return the value for @p arguments. Throws ExcPoint if it is not finite.
    double
    evaluate(const Arguments &arguments) const;

  private:
    Variables                              variables_;
    std::optional<double>                  number_;
    std::vector<Named>                     surfaces_;
    bool                                   depends_on_depth_ = false;
    mutable std::optional<Expression<dim>> expression_; ///< none for a number
    Depth                                  depth_;
  };
} // namespace talus

#endif

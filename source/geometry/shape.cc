// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/shape.h>

namespace talus
{
  using namespace dealii;
  namespace bg = boost::geometry;

  /// @p vertices are closed and brought into Boost's sense of rotation here, so
  /// that the user need not know either. A polygon that crosses itself is
  /// refused: what lies inside of it depends on the convention.
  template <int dim>
  Polygon<dim>::Polygon(const std::string                        &name,
                        const std::vector<std::array<double, 2>> &vertices,
                        const double                              z_lower,
                        const double                              z_upper)
    : z_lower_(z_lower)
    , z_upper_(z_upper)
  {
    // Boost and not formulas of our own, as it also says why a polygon is not
    // valid.
    for (const auto &v : vertices)
      bg::append(polygon_.outer(), BoostPoint(v[0], v[1]));
    bg::correct(polygon_);
    std::string reason;
    AssertThrow(bg::is_valid(polygon_, reason),
                ExcUser(text(name,
                             " do not form a simple polygon: ",
                             reason,
                             ". List the corners in order around the body, "
                             "without crossing edges.")));
  }



  /// The edge belongs to the polygon, as the faces of a box do to a box.
  /// A place that is no number is not contained.
  template <int dim>
  bool
  Polygon<dim>::contains(const Point<dim> &x) const
  {
    if (dim == 3 && !(x[dim - 1] >= z_lower_ && x[dim - 1] <= z_upper_))
      return false;
    return bg::covered_by(BoostPoint(x[0], x[1]), polygon_);
  }



  /// Only within it points need be looked for.
  template <int dim>
  Box<dim>
  Polygon<dim>::bounding_box() const
  {
    const auto envelope =
      bg::return_envelope<bg::model::box<BoostPoint>>(polygon_);
    Box<dim> box;
    box.lower[0] = envelope.min_corner().x();
    box.lower[1] = envelope.min_corner().y();
    box.upper[0] = envelope.max_corner().x();
    box.upper[1] = envelope.max_corner().y();
    if (dim == 3)
      {
        box.lower[dim - 1] = z_lower_;
        box.upper[dim - 1] = z_upper_;
      }
    return box;
  }



  template class Polygon<2>;
  template class Polygon<3>;
} // namespace talus

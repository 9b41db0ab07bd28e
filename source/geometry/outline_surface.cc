// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/outline_surface.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  OutlineSurface<dim>::OutlineSurface(
    const std::string                        &name,
    const std::vector<std::vector<Point<2>>> &outlines,
    const std::vector<double>                &numbers,
    const PlanOnMap<dim>                     &plan)
    : plan_(plan)
    , numbers_(numbers)
  {
    for (std::vector<Point<2>> corners : outlines)
      {
        for (Point<2> &corner : corners)
          corner -= plan.origin();
        polygons_.emplace_back(name, corners);
      }
  }



  template <int dim>
  typename OutlineSurface<dim>::Value
  OutlineSurface<dim>::at(const Point<dim> &x) const
  {
    const auto     place  = plan_.at(x);
    const Point<2> on_map = Point<2>(place.x + (place.origin - plan_.origin()));
    Value          value{-std::numeric_limits<double>::infinity(), {}};
    double         number = 0.;
    for (std::size_t i = 0; i < polygons_.size(); ++i)
      {
        const auto [distance, outwards] =
          polygons_[i].distance_and_normal(on_map);
        if (-distance <= value.height)
          continue;
        value.height = -distance;
        for (unsigned int d = 0; d < dim; ++d)
          value.slope[d] = -(outwards * place.axes[d]);
        number = numbers_.empty() ? 0. : numbers_[i];
      }
    return numbers_.empty() ? value : Value{number, {}};
  }



  template <int dim>
  double
  OutlineSurface<dim>::largest_change(const Point<dim> & /*x*/,
                                      const double distance) const
  {
    if (numbers_.empty())
      return distance;
    const auto [least, most] =
      std::minmax_element(numbers_.begin(), numbers_.end());
    return *most - *least;
  }



  template class OutlineSurface<2>;
  template class OutlineSurface<3>;
} // namespace talus

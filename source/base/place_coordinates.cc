// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/place_coordinates.h>

#include <utility>

namespace talus
{
  using namespace dealii;

  PlaceCoordinates::PlaceCoordinates(const std::string &section,
                                     const std::string &coordinates,
                                     const int          dim,
                                     const Point<3>    &origin)
    : coordinates_(coordinates == "map" ? PlanCoordinates::map
                                        : PlanCoordinates::mesh)
    , origin_(origin)
  {
    AssertThrow(dim == 3 || !are_of_map(),
                ExcUser("'" + section +
                        "/Coordinates' is 'map', but the simulation is "
                        "two-dimensional, and places in a section have no "
                        "easting and northing. Give x along it, and 'mesh'."));
  }



  Point<2>
  PlaceCoordinates::in_plan(const Point<2> &place) const
  {
    return are_of_map() ? Point<2>(place[0] - origin_[0], origin_[1] - place[1])
                        : place;
  }



  Point<2>
  PlaceCoordinates::in_elevation(const Point<2> &place) const
  {
    return are_of_map() ? Point<2>(place[0] - origin_[0], place[1] - origin_[2])
                        : place;
  }



  template <int dim>
  Tensor<1, dim>
  PlaceCoordinates::direction(const Tensor<1, dim> &vector) const
  {
    if constexpr (dim == 3)
      if (are_of_map())
        return Tensor<1, dim>({vector[0], vector[2], -vector[1]});
    return vector;
  }



  template <int dim>
  Point<dim>
  PlaceCoordinates::in_space(const Point<dim> &place) const
  {
    if constexpr (dim == 3)
      if (are_of_map())
        return Point<dim>(place[0] - origin_[0],
                          place[2] - origin_[2],
                          origin_[1] - place[1]);
    return place;
  }



  template <int dim>
  Box<dim>
  PlaceCoordinates::box(const Point<dim> &lower, const Point<dim> &upper) const
  {
    Box<dim> result{in_space(lower), in_space(upper)};
    // The northern corner has the smaller z.
    if (are_of_map())
      std::swap(result.lower[dim - 1], result.upper[dim - 1]);
    return result;
  }



  template Point<2>
  PlaceCoordinates::in_space(const Point<2> &) const;
  template Point<3>
  PlaceCoordinates::in_space(const Point<3> &) const;
  template Tensor<1, 2>
  PlaceCoordinates::direction(const Tensor<1, 2> &) const;
  template Tensor<1, 3>
  PlaceCoordinates::direction(const Tensor<1, 3> &) const;
  template Box<2>
  PlaceCoordinates::box(const Point<2> &, const Point<2> &) const;
  template Box<3>
  PlaceCoordinates::box(const Point<3> &, const Point<3> &) const;
} // namespace talus

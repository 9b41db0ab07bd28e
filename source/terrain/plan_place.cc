// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/terrain/plan_place.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Point<dim>
  parse_plan_place(const std::string    &entry,
                   const std::string    &place,
                   const PlanCoordinates coordinates,
                   const Point<3>       &origin)
  {
    const bool on_map = coordinates == PlanCoordinates::map;
    const auto texts  = Utilities::split_string_list(place, ',');
    AssertThrow(texts.size() == dim - 1 &&
                  std::all_of(texts.begin(),
                              texts.end(),
                              [](const std::string &number) {
                                return Patterns::Double().match(number);
                              }),
                ExcUser(text("'",
                             entry,
                             "' contains '",
                             place,
                             "', where ",
                             dim == 2 ? "one number, x,"
                             : on_map ? "two numbers, easting and northing,"
                                      : "two numbers, x and z,",
                             " were expected.")));
    Point<2> place_in_plan;
    for (unsigned int a = 0; a < texts.size(); ++a)
      place_in_plan[a] = Utilities::string_to_double(texts[a]);
    place_in_plan =
      PlaceCoordinates(coordinates, origin).in_plan(place_in_plan);
    Point<dim> x;
    x[0] = place_in_plan[0];
    if (dim == 3)
      x[dim - 1] = place_in_plan[1];
    return x;
  }



  template decltype(parse_plan_place<2>) parse_plan_place<2>;
  template decltype(parse_plan_place<3>) parse_plan_place<3>;
} // namespace talus

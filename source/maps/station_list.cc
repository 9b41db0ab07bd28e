// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/maps/station_list.h>
#include <talus/terrain/plan_place.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  StationList<dim>::StationList()
    : ParameterAcceptor("/Stations")
  {
    add_parameter("Points",
                  points_,
                  "Places whose history is written to stations.csv: 'name: x' "
                  "in 2-D, 'name: x, z' in 3-D, separated by '|' [m].");
    add_parameter(
      "Lines",
      lines_,
      "Lines, such as routes of pipelines, along which maxima are written to "
      "lines.csv: 'name: x, z; x, z; ...' (in 2-D 'name: x; x'), separated by "
      "'|' [m]. The thresholds of section Maps apply, even if no maps are "
      "written.");
    add_parameter("Coordinates",
                  coordinates_,
                  "Coordinates of places and lines; 'map', 3-D only: easting "
                  "and northing in place of x and z.",
                  this->prm,
                  Patterns::Selection("mesh|map"));
    add_parameter("Width",
                  width_,
                  "Side of the square (in 2-D length of the interval) around a "
                  "place over which means are taken [m]. 0: 'Grid/Cell size'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Drag coefficient",
                  impact_.drag_coefficient,
                  "Factor C_D [-] in the estimated force on a pipeline per "
                  "length and diameter, C_D rho u^2/2 + N_p s_u. The force is "
                  "not written if C_D and N_p are 0.",
                  this->prm,
                  Patterns::Double(0., 1e3));
    add_parameter("Bearing factor",
                  impact_.bearing_factor,
                  "Factor N_p [-] in the estimated force on a pipeline, see "
                  "'Drag coefficient'.",
                  this->prm,
                  Patterns::Double(0., 1e3));
  }



  template <int dim>
  void
  StationList<dim>::check(const Box<dim> &domain) const
  {
    AssertThrow(width_ == 0. || (width_ <= domain.length(0) &&
                                 width_ > 1e-9 * domain.length(0)),
                ExcUser(text("'Stations/Width' is ",
                             width_,
                             " m, on a mesh that is ",
                             domain.length(0),
                             " m long. Set a width between 1e-9 times this "
                             "length and this length.")));
  }



  template <int dim>
  std::vector<typename StationList<dim>::Named>
  StationList<dim>::parse(const std::string &entry,
                          const std::string &value,
                          const Box<dim>    &domain,
                          const Point<3>    &origin) const
  {
    check(domain);
    const PlaceCoordinates coordinates("Stations", coordinates_, dim, origin);
    std::vector<Named>     result;
    for (const std::string &item : Utilities::split_string_list(value, '|'))
      {
        const auto colon = item.find(':');
        Named      named{Utilities::trim(item.substr(0, colon)), {}};
        AssertThrow(colon != std::string::npos && !named.name.empty() &&
                      named.name.find_first_of(",\"") == std::string::npos,
                    ExcUser(text("'Stations/",
                                 entry,
                                 "' contains '",
                                 item,
                                 "', where 'name: place' was expected, with "
                                 "neither comma nor quotation mark in the "
                                 "name.")));
        AssertThrow(std::none_of(result.begin(),
                                 result.end(),
                                 [&](const Named &other) {
                                   return other.name == named.name;
                                 }),
                    ExcUser(text("'Stations/",
                                 entry,
                                 "' has two entries of the name '",
                                 named.name,
                                 "'. Give each entry a different name.")));
        for (const std::string &place :
             Utilities::split_string_list(item.substr(colon + 1), ';'))
          {
            Point<dim> x = parse_plan_place<dim>("Stations/" + entry,
                                                 place,
                                                 coordinates.kind(),
                                                 origin);
            x[1]         = domain.lower[1];
            AssertThrow(domain.contains(x),
                        ExcUser(text("'Stations/",
                                     entry,
                                     "': '",
                                     named.name,
                                     "' has a place '",
                                     place,
                                     "' outside of the mesh. Correct the place "
                                     "(check also 'Stations/Coordinates' and "
                                     "'Grid/Origin'), or make the mesh "
                                     "larger.")));
            named.corners.push_back(x);
          }
        result.push_back(named);
      }
    return result;
  }



  template <int dim>
  std::vector<typename StationList<dim>::Named>
  StationList<dim>::points(const Box<dim> &domain, const Point<3> &origin) const
  {
    const auto points = parse("Points", points_, domain, origin);
    for (const Named &point : points)
      AssertThrow(point.corners.size() == 1,
                  ExcUser(text("'Stations/Points': '",
                               point.name,
                               "' has ",
                               point.corners.size(),
                               " places, where one was expected. Separate "
                               "points by '|', and enter lines in "
                               "'Stations/Lines'.")));
    return points;
  }



  template <int dim>
  std::vector<typename StationList<dim>::Named>
  StationList<dim>::lines(const Box<dim> &domain, const Point<3> &origin) const
  {
    const auto lines = parse("Lines", lines_, domain, origin);
    for (const Named &line : lines)
      {
        double length = 0;
        for (unsigned int i = 1; i < line.corners.size(); ++i)
          length += line.corners[i].distance(line.corners[i - 1]);
        AssertThrow(length > 0,
                    ExcUser(text("'Stations/Lines': '",
                                 line.name,
                                 "' has no length. Give two corners or more, "
                                 "separated by semicolons.")));
      }
    return lines;
  }



  template class StationList<2>;
  template class StationList<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/corner_list.h>
#include <talus/geometry/pipe.h>
#include <talus/geometry/pipe_parameters.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  /// A corner on the other line belongs to only one segment: no crossing is
  /// lost or found twice.
  std::vector<SectionCrossing>
  find_crossings(const std::vector<Point<2>> &section,
                 const std::vector<Point<2>> &route)
  {
    std::vector<SectionCrossing> result;
    for (std::size_t r = 1; r < route.size(); ++r)
      {
        const Tensor<1, 2> segment = route[r] - route[r - 1];
        double             before  = 0.; // length of the legs before this one
        for (std::size_t s = 1; s < section.size(); ++s)
          {
            const Tensor<1, 2> leg    = section[s] - section[s - 1];
            const double       length = leg.norm();
            const Tensor<1, 2> along  = leg / length;
            const auto         beside = [&](const Point<2> &x) {
              return cross_product_2d(along) * (x - section[s - 1]);
            };
            const double from = beside(route[r - 1]), to = beside(route[r]);
            if ((from < 0.) != (to < 0.))
              {
                const Point<2> place =
                  route[r - 1] + from / (from - to) * segment;
                const double x      = along * (place - section[s - 1]);
                const bool is_first = s == 1, is_last = s + 1 == section.size();
                if ((is_first || x >= 0.) && (is_last || x < length))
                  result.push_back(
                    {before + x, std::abs(from - to) / segment.norm()});
              }
            before += length;
          }
      }
    return result;
  }



  namespace
  {
    // Maximum number of pieces of an axis, each as long as the pipe is wide.
    constexpr double max_n_pieces = 1e6;

    // At smaller angles the section of a pipe is an ellipse that a disc cannot
    // approximate.
    constexpr double min_angle = 45.; // degrees

    // Ratio of the axes of the ellipse above which a remark is given.
    constexpr double round_enough = 1.01;



    double
    in_degrees(const SectionCrossing &crossing)
    {
      return std::asin(std::min(crossing.sine, 1.)) * 180. / numbers::PI;
    }
  } // namespace



  template <int dim>
  PipeParameters<dim>::PipeParameters(const std::string &section)
    : ParameterAcceptor(section)
    , section_(section)
  {
    add_parameter("Route",
                  route_,
                  "Corners of the pipe's axis in plan, as x, z; x, z; ... "
                  "[m]. With `Coordinates` = map: as easting, northing [m], "
                  "or the name of a file with one line (GeoJSON, "
                  "shapefile, GeoPackage, KML), in degrees if a surface "
                  "has a `Projection`. In 2-D the pipe is a disc at the "
                  "crossing of the route and the section; the section is z = "
                  "0, or on the map the line of the rasters' `Section`.");
    add_parameter("Height of axis",
                  height_of_axis_,
                  "y of the pipe's axis along the route, linear between "
                  "places a diameter apart: a name of Surfaces/Names, or an "
                  "expression in surface names and x (, z), such as mudline "
                  "+ 0.5 [m].");
  }



  template <int dim>
  std::vector<Point<2>>
  PipeParameters<dim>::corners(const Setting &setting) const
  {
    // Numbers have no letter after a point.
    const std::string ending  = std::filesystem::path(route_).extension();
    const bool        is_file = ending.size() > 1 && std::isalpha(ending[1]);
    AssertThrow(!is_file || setting.coordinates == PlanCoordinates::map,
                ExcUser(path("Route") + " = " + route_ +
                        " is a file, whose places are on the map. Set " +
                        path("Coordinates") + " to 'map'."));
    const std::vector<Point<2>> corners =
      is_file ? setting.surfaces->read_route(path("Route"), route_)
              : parse_corners(path("Route"), route_);
    AssertThrow(corners.size() >= 2,
                ExcUser(
                  text(path("Route"),
                       " has ",
                       corners.size(),
                       " corners, but a pipe needs two or more, separated "
                       "by semicolons.")));
    for (std::size_t i = 1; i < corners.size(); ++i)
      AssertThrow(corners[i] != corners[i - 1],
                  ExcUser(text(path("Route"),
                               " has the corner (",
                               corners[i],
                               ") twice in succession. Remove one of them.")));
    return corners;
  }



  template <int dim>
  double
  PipeParameters<dim>::height(const Setting &setting, const Point<dim> &x) const
  {
    TalusAssert(setting.surfaces != nullptr,
                ExcMessage("There are no surfaces."));
    AssertThrow(!height_of_axis_.empty(),
                ExcUser(
                  path("Height of axis") +
                  " is empty, but needed by a pipe. Give a name of "
                  "'Surfaces/Names', or an expression in surface names, such "
                  "as mudline + 0.5."));
    const auto surface =
      setting.surfaces->surface(path("Height of axis"), height_of_axis_);
    AssertThrow(
      surface->is_known_at(x),
      ExcUser(text(path("Height of axis"),
                   " = ",
                   height_of_axis_,
                   " has no value at (",
                   x,
                   ") m of the mesh, where ",
                   path("Route"),
                   " leads: the raster ends there, or has no data. Give only "
                   "the part of the route on the raster.")));
    return surface->at(x).height;
  }



  template <int dim>
  std::vector<Point<3>>
  PipeParameters<dim>::axis(const Setting &setting) const
  {
    std::vector<Point<3>> axis;
    if constexpr (dim == 3)
      {
        const PlaceCoordinates coordinates(setting.coordinates,
                                           setting.surfaces->origin());
        const auto             in_plan = [&](const Point<2> &corner) {
          const Point<2> x = coordinates.in_plan(corner);
          return Point<3>(x[0], 0., x[1]);
        };
        const auto corners = this->corners(setting);
        axis.push_back(in_plan(corners[0]));
        for (std::size_t i = 1; i < corners.size(); ++i)
          {
            const Point<3>     begin = in_plan(corners[i - 1]);
            const Tensor<1, 3> leg   = in_plan(corners[i]) - begin;
            const double n = std::ceil(leg.norm() / (2. * setting.radius));
            AssertThrow(
              n + axis.size() <= max_n_pieces,
              ExcUser(text(
                path("Route"),
                " is ",
                leg.norm(),
                " m long between its corners ",
                i,
                " and ",
                i + 1,
                ", which is too long for a pipe with ",
                path("Radius"),
                " = ",
                setting.radius,
                " m: at most ",
                max_n_pieces,
                " diameters were expected. Give only the part of the route "
                "in the mesh.")));
            for (double j = 1; j <= n; ++j)
              axis.push_back(begin + j / n * leg);
          }
        for (Point<3> &x : axis)
          x[1] = height(setting, x);
      }
    return axis;
  }



  template <int dim>
  SectionCrossing
  PipeParameters<dim>::crossing(const Setting &setting) const
  {
    const bool on_map = setting.coordinates == PlanCoordinates::map;
    const auto crossings =
      find_crossings(on_map ? setting.surfaces->section(path("Route"))
                            : std::vector<Point<2>>{{0., 0.}, {1., 0.}},
                     corners(setting));
    AssertThrow(!crossings.empty(),
                ExcUser(text(path("Route"),
                             " = ",
                             route_,
                             " does not cross the section",
                             on_map ? ", the line of the rasters' `Section`"
                                    : ", z = 0",
                             ". Correct it (and look at ",
                             path("Coordinates"),
                             "), or leave the pipe out.")));
    AssertThrow(
      crossings.size() == 1,
      ExcUser(text(path("Route"),
                   " crosses the section at x = ",
                   crossings[0].length,
                   " m, at x = ",
                   crossings[1].length,
                   " m and perhaps again. A section has one obstacle for each "
                   "crossing: give each obstacle only the part of the route "
                   "at the crossing.")));
    AssertThrow(
      in_degrees(crossings[0]) >= min_angle,
      ExcUser(text(path("Route"),
                   " crosses the section at ",
                   std::setprecision(3),
                   in_degrees(crossings[0]),
                   " degrees. A pipe along the section is not a disc in the "
                   "section: at least ",
                   min_angle,
                   " degrees were expected. Lay the section more "
                   "across the route, or compute in 3-D.")));
    return crossings[0];
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  PipeParameters<dim>::make(const Setting &setting) const
  {
    if constexpr (dim == 3)
      return std::make_unique<Pipe>(axis(setting), setting.radius);
    else
      {
        Point<dim> centre(crossing(setting).length, 0.);
        centre[1] = height(setting, centre);
        return std::make_unique<Ball<dim>>(centre, setting.radius);
      }
  }



  template <int dim>
  std::string
  PipeParameters<dim>::place_in_words(const Setting &setting) const
  {
    if constexpr (dim == 3)
      {
        const auto axis   = this->axis(setting);
        double     length = 0., lowest = axis[0][1], highest = axis[0][1];
        for (std::size_t i = 1; i < axis.size(); ++i)
          {
            length += axis[i].distance(axis[i - 1]);
            lowest  = std::min(lowest, axis[i][1]);
            highest = std::max(highest, axis[i][1]);
          }
        return text(std::setprecision(6),
                    "is a pipe of ",
                    length,
                    " m, from (",
                    axis.front(),
                    ") to (",
                    axis.back(),
                    ") m; its axis has y from ",
                    lowest,
                    " m to ",
                    highest,
                    " m.");
      }
    else
      {
        const SectionCrossing crossing = this->crossing(setting);
        return text(std::setprecision(6),
                    "crosses the section at x = ",
                    crossing.length,
                    " m, y = ",
                    height(setting, Point<dim>(crossing.length, 0.)),
                    " m, at ",
                    std::setprecision(3),
                    in_degrees(crossing),
                    " degrees.");
      }
  }



  template <int dim>
  std::string
  PipeParameters<dim>::remark(const Setting &setting) const
  {
    if (dim == 3)
      return "";
    const SectionCrossing crossing = this->crossing(setting);
    if (round_enough * crossing.sine >= 1.)
      return "";
    return text(std::setprecision(3),
                "crosses the section at ",
                in_degrees(crossing),
                " degrees, where the section of a pipe is an ellipse, ",
                1. / crossing.sine,
                " times as long as high. The ellipse is replaced by a disc "
                "of the pipe's radius: the force is the force of soil "
                "moving perpendicular to the pipe. For oblique motion lay "
                "the section across the route, or compute in 3-D.");
  }



  template class PipeParameters<2>;
  template class PipeParameters<3>;
} // namespace talus

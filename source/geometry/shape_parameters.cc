// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/corner_list.h>
#include <talus/geometry/intersection.h>
#include <talus/geometry/polygon.h>
#include <talus/geometry/shape_parameters.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Return the prism over @p base, see Prism; in 2-D the base.
    template <int dim>
    std::unique_ptr<Shape<dim>>
    over(std::unique_ptr<Shape<2>>    base,
         const std::array<double, 2> &ends,
         const unsigned int           axis = 2)
    {
      if constexpr (dim == 2)
        return base;
      else
        return std::make_unique<Prism>(std::move(base), ends[0], ends[1], axis);
    }
  } // namespace



  template <int dim>
  ShapeParameters<dim>::ShapeParameters(const std::string &section)
    : ParameterAcceptor(section)
    , section_(section)
    , pipe_(section)
  {
    add_parameter(
      "Shape",
      shape_,
      "Must be given: 'polygon' (see Vertices, Open; in 3-D a prism over it), "
      "'box' (see Lower corner, Upper corner), 'ball' (a disc in "
      "2-D; see Centre, Radius, Inner radius), 'cylinder' (along "
      "z, in 2-D the same as ball; or along Axis), 'cone' (in 3-D, with or "
      "without the tip; see Axis, Radius, End radius), 'pipe' (along a line in "
      "plan; see Route, "
      "Height of axis, Radius), 'half-plane' (in 3-D a half "
      "of space; see Point, Normal), 'terrain' (all below a "
      "surface; see Surface) or 'layer' (between two surfaces; see "
      "Upper surface, Lower surface).",
      this->prm,
      Patterns::Selection(
        "|polygon|box|ball|cylinder|cone|pipe|half-plane|terrain|layer"));
    add_parameter("Coordinates",
                  coordinates_,
                  "'map', in 2-D only for the route of a pipe: all places of "
                  "this section are on the map. A place x, y, z is easting, "
                  "northing, height; x, z in plan are easting, northing; x, "
                  "y of a polygon are easting, height; the ends along z are "
                  "the southern and the northern end. Expressions keep x, y, "
                  "z.",
                  this->prm,
                  Patterns::Selection("mesh|map"));
    declare_parameters_of_boxes();
    declare_parameters_of_round_shapes();
    declare_parameters_of_polygon_and_half_plane();
    declare_parameters_of_surfaces();
  }



  template <int dim>
  void
  ShapeParameters<dim>::declare_parameters_of_boxes()
  {
    add_parameter("Lower corner",
                  lower_corner_,
                  "Corner of the box with the smallest coordinates [m]. Of a "
                  "layer, where it ends along x (and z); y does not count.");
    add_parameter("Upper corner",
                  upper_corner_,
                  "Corner of the box with the largest coordinates [m]; of a "
                  "layer as the lower one.");
  }



  template <int dim>
  void
  ShapeParameters<dim>::declare_parameters_of_round_shapes()
  {
    add_parameter("Centre",
                  centre_,
                  "Centre of the ball; of the cylinder any place on its axis "
                  "[m].");
    add_parameter("Radius",
                  radius_,
                  "Radius of the ball, cylinder or pipe, of the cone at the "
                  "beginning of its axis [m].",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Axis",
                  axis_,
                  "3-D only: both ends of the axis of a cylinder or cone, as "
                  "x,y,z; x,y,z [m]. Empty: the cylinder lies along z.");
    add_parameter("End radius",
                  end_radius_,
                  "Radius of the cone at the end of its axis, 0 for a tip [m].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Inner radius",
                  inner_radius_,
                  "Radius of the hollow in the ball or cylinder, for a ring "
                  "(in 3-D a shell or pipe) [m].",
                  this->prm,
                  Patterns::Double(0.));
  }



  template <int dim>
  void
  ShapeParameters<dim>::declare_parameters_of_polygon_and_half_plane()
  {
    add_parameter("Vertices",
                  vertices_,
                  "Corners of the polygon in order, as x,y; x,y; ... [m]. "
                  "For a layer, the outline that limits the layer: in 3-D in "
                  "plan, as x,z; x,z; ...");
    add_parameter("Open",
                  is_open_,
                  "true: the vertices form a surface with endless first and "
                  "last edges and the solid on the right, which is below for "
                  "vertices from left to right. false: the vertices form a "
                  "closed polygon.");
    add_parameter("Extent in z",
                  extent_z_,
                  "3-D only: lower and upper end of the prism over the polygon "
                  "or of the cylinder [m]; empty for the whole mesh.");
    add_parameter("Point",
                  point_,
                  "Any place on the face of the half-plane [m].");
    add_parameter(
      "Normal",
      normal_,
      "Vector of any length that points out of the half-plane; with "
      "`Coordinates` = map to east, north and up [-].");
  }



  template <int dim>
  void
  ShapeParameters<dim>::declare_parameters_of_surfaces()
  {
    const std::string sentence = ": a name of Surfaces/Names, or an expression "
                                 "in these names and x (, z), "
                                 "as mudline - 5 [m].";
    add_parameter("Surface",
                  surface_,
                  "Upper surface of the terrain" + sentence);
    add_parameter("Upper surface",
                  upper_surface_,
                  "Where the layer ends upwards" + sentence);
    add_parameter("Lower surface",
                  lower_surface_,
                  "Where the layer ends downwards" + sentence);
  }



  template <int dim>
  std::string
  ShapeParameters<dim>::path(const std::string &entry) const
  {
    return "'" + section_.substr(1) + "/" + entry + "'";
  }



  /// In 2-D only the route of a pipe may be on the map.
  template <int dim>
  PlaceCoordinates
  ShapeParameters<dim>::coordinates() const
  {
    return PlaceCoordinates(section_.substr(1),
                            dim == 2 && is_pipe() ? "mesh" : coordinates_,
                            dim,
                            surfaces_ != nullptr ? surfaces_->origin()
                                                 : Point<3>());
  }



  template <int dim>
  typename PipeParameters<dim>::Setting
  ShapeParameters<dim>::setting_of_pipe() const
  {
    return {coordinates_ == "map" ? PlanCoordinates::map
                                  : PlanCoordinates::mesh,
            radius_,
            surfaces_};
  }



  /// Made anew in each call: a shape is cheap, and the ends of a prism depend
  /// on the domain, known only after the mesh.
  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make(const Box<dim> &domain) const
  {
    // Also reached for a listed section that is missing.
    AssertThrow(
      !shape_.empty(),
      ExcUser(
        text(path("Shape"),
             " is not given, but 'polygon', 'box', 'ball', 'cylinder', "
             "'cone', 'pipe', 'half-plane', 'terrain' or 'layer' is expected "
             "there. Add the entry and the further entries of the shape "
             "to the section '",
             section_.substr(1),
             "', or the whole section, or remove the name "
             "from '",
             section_.substr(1, section_.rfind('/') - 1),
             "/Names'.")));
    if (shape_ == "half-plane")
      return make_half_space();
    if (shape_ == "box")
      return make_box();
    if (shape_ == "terrain")
      return make_side("Surface", surface_, SideOfSurface<dim>::Side::below);
    if (shape_ == "layer")
      return make_layer(domain);
    if (shape_ == "polygon")
      {
        const std::string         name = "The vertices in " + path("Vertices");
        std::unique_ptr<Shape<2>> base;
        if (is_open_)
          base = std::make_unique<OpenPolygon>(name, vertices(false));
        else
          base = std::make_unique<Polygon>(name, vertices(false));
        return over<dim>(std::move(base), extent_z(domain));
      }
    if (is_pipe())
      return pipe_.make(setting_of_pipe());
    check_radii();
    const Point<dim> centre = coordinates().in_space(centre_);
    if (shape_ == "ball")
      return std::make_unique<Ball<dim>>(centre, radius_, inner_radius_);
    if (shape_ == "cone" || !axis_.empty())
      return make_frustum();
    return over<dim>(std::make_unique<Ball<2>>(Point<2>(centre[0], centre[1]),
                                               radius_,
                                               inner_radius_),
                     extent_z(domain));
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_frustum() const
  {
    AssertThrow(dim == 3 && axis_.size() == 2 && axis_[0] != axis_[1],
                ExcUser(text(path("Axis"),
                             " has ",
                             counted(axis_.size(), "place"),
                             " in ",
                             dim,
                             "-D, but a ",
                             shape_,
                             " needs two different places, as x,y,z; x,y,z, "
                             "in 3-D. Correct the entry; in 2-D use a "
                             "polygon.")));
    if constexpr (dim == 3)
      {
        const bool is_cone = shape_ == "cone";
        return std::make_unique<Frustum>(coordinates().in_space(axis_[0]),
                                         coordinates().in_space(axis_[1]),
                                         radius_,
                                         is_cone ? end_radius_ : radius_,
                                         is_cone ? 0. : inner_radius_);
      }
    return nullptr;
  }



  template <int dim>
  std::vector<Point<2>>
  ShapeParameters<dim>::vertices(const bool are_in_plan) const
  {
    const PlaceCoordinates coordinates = this->coordinates();
    std::vector<Point<2>> vertices = parse_corners(path("Vertices"), vertices_);
    for (Point<2> &vertex : vertices)
      vertex = are_in_plan ? coordinates.in_plan(vertex)
                           : coordinates.in_elevation(vertex);
    return vertices;
  }



  /// Return the ends of a prism, by default the ends of the mesh.
  template <int dim>
  std::array<double, 2>
  ShapeParameters<dim>::extent_z(const Box<dim> &domain) const
  {
    if (extent_z_.empty())
      return {{domain.lower[dim - 1], domain.upper[dim - 1]}};
    AssertThrow(dim == 3,
                ExcUser(text(path("Extent in z"),
                             " = '",
                             extent_z_,
                             "' is given, but the simulation is "
                             "two-dimensional. Remove the entry, or set "
                             "'Dimension' to 3.")));
    const auto z = Utilities::split_string_list(extent_z_, ',');
    AssertThrow(z.size() == 2 && Patterns::Double().match(z[0]) &&
                  Patterns::Double().match(z[1]),
                ExcUser(text(path("Extent in z"),
                             " = '",
                             extent_z_,
                             "' must be two numbers separated by a "
                             "comma, or empty.")));
    const std::array<double, 2> ends = {
      {Utilities::string_to_double(z[0]), Utilities::string_to_double(z[1])}};
    AssertThrow(ends[0] < ends[1],
                ExcUser(
                  text(path("Extent in z"),
                       " = '",
                       extent_z_,
                       "' ends before the beginning; give the lower end first, "
                       "and a positive length.")));
    if (!coordinates().are_of_map())
      return ends;
    // The northern end has the smaller z.
    return {{coordinates().in_plan(Point<2>(0., ends[1]))[1],
             coordinates().in_plan(Point<2>(0., ends[0]))[1]}};
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_half_space() const
  {
    AssertThrow(normal_.norm() > 0.,
                ExcUser(text(path("Normal"),
                             " = (",
                             normal_,
                             ") has no direction. Give a vector that points "
                             "out of the half-plane, of any length but 0.")));
    return std::make_unique<HalfSpace<dim>>(coordinates().in_space(point_),
                                            coordinates().direction(normal_));
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_box() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      AssertThrow(lower_corner_[d] < upper_corner_[d],
                  ExcUser(text(path("Upper corner"),
                               " = (",
                               upper_corner_,
                               ") must lie above the lower corner (",
                               lower_corner_,
                               ") in every coordinate.")));
    return std::make_unique<BoxRegion<dim>>(
      coordinates().box(lower_corner_, upper_corner_));
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_side(
    const std::string                      &entry,
    const std::string                      &expression,
    const typename SideOfSurface<dim>::Side side) const
  {
    TalusAssert(surfaces_ != nullptr,
                ExcMessage("use_surfaces() was not called."));
    AssertThrow(!expression.empty(),
                ExcUser(text(path(entry),
                             " is empty, but a ",
                             shape_,
                             " needs it. Give a name of 'Surfaces/Names', or "
                             "an expression in x",
                             dim == 3 ? ", z" : "",
                             " and these names.")));
    return std::make_unique<SideOfSurface<dim>>(surfaces_->surface(path(entry),
                                                                   expression),
                                                side);
  }



  /// Limits in plan come first: the surfaces may be undefined beyond.
  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_layer(const Box<dim> &domain) const
  {
    using Side = typename SideOfSurface<dim>::Side;
    typename Intersection<dim>::Parts parts;
    if (!(lower_corner_ == upper_corner_))
      {
        Box<dim> box = coordinates().box(lower_corner_, upper_corner_);
        box.upper[1] = infinity;
        box.lower[1] = -infinity;
        for (unsigned int d = 0; d < dim; d += 2)
          AssertThrow(box.lower[d] < box.upper[d],
                      ExcUser(text(path("Upper corner"),
                                   " = (",
                                   upper_corner_,
                                   ") must lie beyond the lower corner (",
                                   lower_corner_,
                                   ") along each axis but y.")));
        parts.push_back(std::make_unique<BoxRegion<dim>>(box));
      }
    if (!vertices_.empty())
      parts.push_back(over<dim>(std::make_unique<Polygon>("The vertices in " +
                                                            path("Vertices"),
                                                          vertices(true)),
                                {{-infinity, infinity}},
                                1));
    parts.push_back(make_side("Upper surface", upper_surface_, Side::below));
    parts.push_back(make_side("Lower surface", lower_surface_, Side::above));
    auto layer = std::make_unique<Intersection<dim>>(std::move(parts));
    check_top(*layer, domain);
    return layer;
  }



  /// Soil above the top of the mesh would be left out silently. (Below the mesh
  /// soil may be left out, because layers may be endless.) Checked at some
  /// places of the top face.
  template <int dim>
  void
  ShapeParameters<dim>::check_top(const Shape<dim> &layer,
                                  const Box<dim>   &domain) const
  {
    constexpr unsigned int n = (dim == 2 ? 1000 : 100);
    if (std::isinf(domain.upper[1]))
      return;
    for (unsigned int i = 0; i < std::pow(n, dim - 1); ++i)
      {
        const unsigned int row = i / n;
        Point<dim>         x   = domain.lower;
        x[0] += (i % n + 0.5) / n * domain.length(0);
        if (dim == 3)
          x[dim - 1] += (row + 0.5) / n * domain.length(dim - 1);
        x[1] = domain.upper[1] + 1e-9 * domain.length(1);
        AssertThrow(!layer.contains(x),
                    ExcUser(text(path("Upper surface"),
                                 " = ",
                                 upper_surface_,
                                 " lies above the top of the mesh at (",
                                 x,
                                 ") m. Make the mesh higher ('Grid/Upper "
                                 "corner') or the layer smaller.")));
      }
  }



  template <int dim>
  void
  ShapeParameters<dim>::check_radii() const
  {
    AssertThrow(inner_radius_ < radius_,
                ExcUser(text(path("Inner radius"),
                             " = ",
                             inner_radius_,
                             " m leaves nothing of the ",
                             shape_,
                             ", whose radius is ",
                             radius_,
                             " m. Give a smaller one.")));
  }



  template class ShapeParameters<2>;
  template class ShapeParameters<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/geometry/polygon.h>
#include <talus/geometry/shape_parameters.h>

#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  ShapeParameters<dim>::ShapeParameters(const std::string &section)
    : ParameterAcceptor(section)
    , section_(section)
  {
    add_parameter(
      "Shape",
      shape_,
      "Must be given: 'polygon' (see Vertices, Open; in 3-D a prism over it), "
      "'box' (see Lower corner, Upper corner), 'ball' (a disc in "
      "2-D; see Centre, Radius, Inner radius), 'cylinder' (along "
      "z; in 2-D the same as ball) or 'half-plane' (in 3-D a half "
      "of space; see Point, Normal).",
      this->prm,
      Patterns::Selection("|polygon|box|ball|cylinder|half-plane"));
    add_parameter("Lower corner",
                  lower_corner_,
                  "Corner of the box with the smallest coordinates [m].");
    add_parameter("Upper corner",
                  upper_corner_,
                  "Corner of the box with the largest coordinates [m].");
    add_parameter("Centre",
                  centre_,
                  "Centre of the ball; of the cylinder any place on its axis "
                  "[m].");
    add_parameter("Radius",
                  radius_,
                  "Radius of the ball or cylinder [m].",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Inner radius",
                  inner_radius_,
                  "Radius of the hollow in the ball or cylinder, which makes "
                  "it a ring (in 3-D a shell or pipe) [m].",
                  this->prm,
                  Patterns::Double(0.));
    declare_parameters_of_polygon_and_half_plane();
  }



  template <int dim>
  void
  ShapeParameters<dim>::declare_parameters_of_polygon_and_half_plane()
  {
    add_parameter("Vertices",
                  vertices_,
                  "Corners of the polygon in order, as x,y; x,y; ... [m].");
    add_parameter("Open",
                  is_open_,
                  "Whether the vertices are those of a surface whose first and "
                  "last edges go on for ever, with the solid on its right: "
                  "below it if they are listed from left to right. false: "
                  "those of a closed polygon.");
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
      "Vector of any length that points out of the half-plane [-].");
  }



  template <int dim>
  std::string
  ShapeParameters<dim>::path(const std::string &entry) const
  {
    return "'" + section_.substr(1) + "/" + entry + "'";
  }



  /// Made anew by whoever asks: a shape is cheap, and needs the domain for the
  /// ends of a prism, which is known only when the mesh is.
  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make(const Box<dim> &domain) const
  {
    // A section that is listed by name but missing looks the same.
    AssertThrow(!shape_.empty(),
                ExcUser(text(path("Shape"),
                             " is not given, but 'polygon', 'box', 'ball', "
                             "'cylinder' or 'half-plane' is expected there. "
                             "Add it and the entries that it needs to the "
                             "section '",
                             section_.substr(1),
                             "', or the whole section, or remove the name "
                             "from '",
                             section_.substr(1, section_.rfind('/') - 1),
                             "/Names'.")));
    if (shape_ == "half-plane")
      return make_half_space();
    if (shape_ == "box")
      return make_box();
    if (shape_ == "polygon")
      {
        const std::string         name = "The vertices in " + path("Vertices");
        std::unique_ptr<Shape<2>> base;
        if (is_open_)
          base = std::make_unique<OpenPolygon>(name, vertices());
        else
          base = std::make_unique<Polygon>(name, vertices());
        return make_over(std::move(base), domain);
      }
    check_radii();
    if (shape_ == "ball")
      return std::make_unique<Ball<dim>>(centre_, radius_, inner_radius_);
    return make_over(std::make_unique<Ball<2>>(Point<2>(centre_[0], centre_[1]),
                                               radius_,
                                               inner_radius_),
                     domain);
  }



  /// Reads "x,y; x,y; ...".
  template <int dim>
  std::vector<Point<2>>
  ShapeParameters<dim>::vertices() const
  {
    std::vector<Point<2>> vertices;
    for (const auto &vertex : Utilities::split_string_list(vertices_, ';'))
      {
        const auto numbers = Utilities::split_string_list(vertex, ',');
        AssertThrow(numbers.size() == 2 &&
                      Patterns::Double().match(numbers[0]) &&
                      Patterns::Double().match(numbers[1]),
                    ExcUser(text(path("Vertices"),
                                 " contains '",
                                 vertex,
                                 "', where two numbers 'x,y' were expected; "
                                 "vertices are separated by semicolons.")));
        vertices.emplace_back(Utilities::string_to_double(numbers[0]),
                              Utilities::string_to_double(numbers[1]));
      }
    return vertices;
  }



  /// The ends of a prism, which are those of the mesh unless given.
  template <int dim>
  std::array<double, 2>
  ShapeParameters<dim>::extent_z(const Box<dim> &domain) const
  {
    if (extent_z_.empty())
      return {{domain.lower[dim - 1], domain.upper[dim - 1]}};
    const auto z = Utilities::split_string_list(extent_z_, ',');
    AssertThrow(z.size() == 2 && Patterns::Double().match(z[0]) &&
                  Patterns::Double().match(z[1]),
                ExcUser(text(path("Extent in z"),
                             " = '",
                             extent_z_,
                             "' must be two numbers separated by a "
                             "comma, or empty.")));
    return {
      {Utilities::string_to_double(z[0]), Utilities::string_to_double(z[1])}};
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
    return std::make_unique<HalfSpace<dim>>(point_, normal_);
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
      Box<dim>{lower_corner_, upper_corner_});
  }



  template <int dim>
  std::unique_ptr<Shape<dim>>
  ShapeParameters<dim>::make_over(std::unique_ptr<Shape<2>> base,
                                  const Box<dim>           &domain) const
  {
    // A malformed extent is an error in 2-D, too.
    const std::array<double, 2> z = extent_z(domain);
    if constexpr (dim == 2)
      return base;
    else
      return std::make_unique<Prism>(std::move(base), z[0], z[1]);
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

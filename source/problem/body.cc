// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/body.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  /// Each body has a section named after it, which its initial state shares.
  /// Entries that its shape does not use are ignored.
  template <int dim>
  Body<dim>::Body(const std::string &name)
    : ParameterAcceptor("/Bodies/" + name)
    , name_(name)
    , initial_state_("/Bodies/" + name)
  {
    add_parameter("Shape",
                  shape_,
                  "'polygon' (see Vertices; in 3-D a prism over it), 'box' "
                  "(see Lower corner, Upper corner) or 'ball' (a disc in 2-D; "
                  "see Centre, Radius, Inner radius).",
                  this->prm,
                  Patterns::Selection("polygon|box|ball"));
    add_parameter("Vertices",
                  vertices_,
                  "Corners of the polygon in order, as x,y; x,y; ... [m].");
    add_parameter("Extent in z",
                  extent_z_,
                  "3-D only: lower and upper end of the prism over the polygon "
                  "[m]; empty for the whole mesh.");
    add_parameter("Lower corner",
                  lower_corner_,
                  "Corner of the box with the smallest coordinates [m].");
    add_parameter("Upper corner",
                  upper_corner_,
                  "Corner of the box with the largest coordinates [m].");
    add_parameter("Centre", centre_, "Centre of the ball [m].");
    add_parameter("Radius",
                  radius_,
                  "Radius of the ball [m].",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Inner radius",
                  inner_radius_,
                  "Radius of the hollow in the ball, which makes it a ring "
                  "(in 3-D a shell) [m].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Material",
                  material_,
                  "One of the names in Materials/Names.");
    add_parameter("Points per cell and axis",
                  points_per_cell_,
                  "Number of material points along each axis of a cell: one "
                  "number for all axes, or one for each, separated by commas.",
                  this->prm,
                  Patterns::List(Patterns::Integer(1, 16), 1, dim));
  }



  /// Reads "x,y; x,y; ..." and, in 3-D, the ends of the prism, which are those
  /// of the mesh unless given.
  template <int dim>
  std::unique_ptr<Shape<dim>>
  Body<dim>::make_polygon(const Box<dim> &domain) const
  {
    std::vector<std::array<double, 2>> vertices;
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
        vertices.push_back({{Utilities::string_to_double(numbers[0]),
                             Utilities::string_to_double(numbers[1])}});
      }
    double z_lower = domain.lower[dim - 1], z_upper = domain.upper[dim - 1];
    if (!extent_z_.empty())
      {
        const auto z = Utilities::split_string_list(extent_z_, ',');
        AssertThrow(z.size() == 2 && Patterns::Double().match(z[0]) &&
                      Patterns::Double().match(z[1]),
                    ExcUser(text(path("Extent in z"),
                                 " = '",
                                 extent_z_,
                                 "' must be two numbers separated by a "
                                 "comma, or empty.")));
        z_lower = Utilities::string_to_double(z[0]);
        z_upper = Utilities::string_to_double(z[1]);
      }
    return std::make_unique<Polygon<dim>>("The vertices in " + path("Vertices"),
                                          vertices,
                                          z_lower,
                                          z_upper);
  }



  /// Made anew by whoever asks: a shape is cheap, and needs the domain for the
  /// ends of a prism, which is known only when the mesh is.
  template <int dim>
  std::unique_ptr<Shape<dim>>
  Body<dim>::make_shape(const Box<dim> &domain) const
  {
    if (shape_ == "polygon")
      return make_polygon(domain);
    if (shape_ == "ball")
      {
        AssertThrow(inner_radius_ < radius_,
                    ExcUser(text(path("Inner radius"),
                                 " = ",
                                 inner_radius_,
                                 " m leaves nothing of the ball, whose radius "
                                 "is ",
                                 radius_,
                                 " m. Give a smaller one.")));
        return std::make_unique<Ball<dim>>(centre_, radius_, inner_radius_);
      }
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



  /// @p domain is that of the parameters: faces that moved to make room for
  /// large cells are no place for soil.
  template <int dim>
  Box<dim>
  Body<dim>::bounding_box(const Box<dim> &domain) const
  {
    const Box<dim> box = make_shape(domain)->bounding_box();
    check_inside(box, domain);
    return box;
  }



  /// The tolerance lets a body end on a face of the mesh whatever the round-off
  /// of both.
  template <int dim>
  void
  Body<dim>::check_inside(const Box<dim> &box, const Box<dim> &domain) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double tolerance = 1e-9 * domain.length(d);
        AssertThrow(box.lower[d] >= domain.lower[d] - tolerance &&
                      box.upper[d] <= domain.upper[d] + tolerance,
                    ExcUser(text("The body '",
                                 name_,
                                 "' reaches from ",
                                 box.lower[d],
                                 " m to ",
                                 box.upper[d],
                                 " m along axis ",
                                 d,
                                 ", but the mesh only from ",
                                 domain.lower[d],
                                 " m to ",
                                 domain.upper[d],
                                 " m. Make the mesh larger ('Grid/Lower "
                                 "corner', 'Grid/Upper corner') or move the "
                                 "body.")));
      }
  }



  /// A point at @p x, m, at rest and undeformed (F = I), without stress. Its
  /// box is a part of a cell, so that the boxes of a cell tile it. @p density
  /// in kg/m^3.
  template <int dim>
  void
  Body<dim>::add_point(Points<dim>       &points,
                       const unsigned int index,
                       const Point<dim>  &x,
                       const double       cell_size,
                       const double       density) const
  {
    const unsigned int p      = points.append(1);
    double             volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        // One number of points for all axes, or one for each.
        const double length =
          cell_size / points_per_cell_[points_per_cell_.size() == 1 ? 0 : d];
        volume *= length;
        points.data(points.position, d)[p]                         = x[d];
        points.data(points.initial_position, d)[p]                 = x[d];
        points.data(points.reference_length, d)[p]                 = length;
        points.data(points.stretch, d)[p]                          = 1.;
        points.data(points.creation_stretch, d)[p]                 = 1.;
        points.data(points.deformation_gradient, d * (dim + 1))[p] = 1.;
      }
    points.data(points.reference_volume)[p] = volume;
    points.data(points.mass)[p]             = density * volume;
    points.data(points.body)[p]             = index;
  }



  /// Two bodies that overlap would put twice the mass into the same place,
  /// which no later check would notice. Looked at by the points there are, in
  /// the order of Bodies/Names. Each rank looks at its own: points and body are
  /// on the same cells.
  template <int dim>
  void
  Body<dim>::check_apart(const Shape<dim>  &shape,
                         const Points<dim> &points) const
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto x = load_place(points, points.initial_position, p);
        AssertThrow(!shape.contains(x),
                    ExcUser(text("The body '",
                                 name_,
                                 "' contains the point at (",
                                 x,
                                 ") m, which belongs to a body listed before "
                                 "it in Bodies/Names. Bodies must not "
                                 "overlap: move or reshape one of them.")));
      }
  }



  /// Points lie at the centres of the parts into which each cell is cut, and
  /// belong to the body if their centre does: no part is cut by the surface of
  /// the body. So its volume is right only to the size of a point, but all
  /// boxes tile their cells and the weights begin without gaps and overlaps.
  /// Each rank fills its own cells. Collective.
  template <int dim>
  void
  Body<dim>::create_points(const Grid<dim>   &grid,
                           const unsigned int index,
                           const double       density,
                           Points<dim>       &points) const
  {
    AssertThrow(points_per_cell_.size() == 1 || points_per_cell_.size() == dim,
                ExcUser(text(path("Points per cell and axis"),
                             " lists ",
                             points_per_cell_.size(),
                             " numbers; give one, or one for each of the ",
                             dim,
                             " axes.")));
    const auto     shape = make_shape(grid.domain_before_growth());
    const Box<dim> box   = bounding_box(grid.domain_before_growth());
    check_apart(*shape, points);

    const unsigned int n_before = points.size();
    // Points per cell whatever its size: in smaller cells there are smaller
    // boxes.
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim>              &cell     = grid.cells()[c];
        bool                          overlaps = true;
        std::array<unsigned int, dim> n, at{};
        for (unsigned int d = 0; d < dim; ++d)
          {
            // Most cells of the mesh are far from the body, and are passed over
            // at once.
            overlaps = overlaps && cell.lower[d] < box.upper[d] &&
                       cell.lower[d] + cell.size > box.lower[d];
            n[d] = points_per_cell_[points_per_cell_.size() == 1 ? 0 : d];
          }
        while (overlaps && at[dim - 1] < n[dim - 1])
          {
            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = cell.lower[d] + (at[d] + 0.5) / n[d] * cell.size;
            if (shape->contains(x))
              add_point(points, index, x, cell.size, density);
            // Counts through all parts of a cell, the first axis fastest.
            ++at[0];
            for (unsigned int d = 0; d + 1 < dim && at[d] == n[d]; ++d)
              {
                at[d] = 0;
                ++at[d + 1];
              }
          }
      }
    // A rank may well have none, but one of them must have some.
    AssertThrow(Utilities::MPI::max(points.size() - n_before,
                                    grid.communicator()) > 0,
                ExcUser(text("The body '",
                             name_,
                             "' got no points: no centre of a point lies in "
                             "it. Make it larger than a cell (Grid/Cell size) "
                             "or raise ",
                             path("Points per cell and axis"),
                             ".")));
  }



  template class Body<2>;
  template class Body<3>;
} // namespace talus

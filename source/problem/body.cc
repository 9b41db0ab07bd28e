// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/body.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  /// Each body has a section named after it, which its shape and initial state
  /// share.
  template <int dim>
  Body<dim>::Body(const std::string &name)
    : ParameterAcceptor("/Bodies/" + name)
    , name_(name)
    , shape_("/Bodies/" + name, "box")
    , initial_state_("/Bodies/" + name)
  {
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



  /// @p domain is that of the parameters: faces that moved to make room for
  /// large cells are no place for soil. A shape that has no end ends there.
  template <int dim>
  Box<dim>
  Body<dim>::bounding_box(const Box<dim> &domain) const
  {
    Box<dim> box = shape_.make(domain)->bounding_box();
    for (unsigned int d = 0; d < dim; ++d)
      {
        if (std::isinf(box.lower[d]))
          box.lower[d] = domain.lower[d];
        if (std::isinf(box.upper[d]))
          box.upper[d] = domain.upper[d];
      }
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
    const auto     shape = shape_.make(grid.domain_before_growth());
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/analytic_shapes.h>
#include <talus/problem/body.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  /// Each body has a section named after it, which its shape and initial state
  /// share.
  template <int dim>
  Body<dim>::Body(const std::string &name)
    : ParameterAcceptor("/Bodies/" + name)
    , name_(name)
    , shape_("/Bodies/" + name)
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
    add_parameter("Filling",
                  filling_,
                  "'clipped': boxes of points cut by the surface of the body; "
                  "the points lie at the centroids of what is left, and the "
                  "mass is that of the shape. 'centres': whole boxes, those "
                  "whose centre lies in the body, so that its surface is a "
                  "staircase and its volume right to the size of a point.",
                  this->prm,
                  Patterns::Selection("clipped|centres"));
    add_parameter("Cut by obstacles",
                  cut_by_obstacles_,
                  "Whether what of the body lies inside of obstacles is "
                  "removed, so that it is filled down to them. false: that is "
                  "an error.");
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
                    // More digits than the tolerance has.
                    ExcUser(text(std::setprecision(12),
                                 "The body '",
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



  /// A point at rest and undeformed (F = I), without stress. @p density in
  /// kg/m^3.
  template <int dim>
  void
  Body<dim>::add_point(Points<dim>         &points,
                       const unsigned int   index,
                       const NewPoint<dim> &point,
                       const double         density) const
  {
    const unsigned int p      = points.append(1);
    double             volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        volume *= point.length[d];
        points.data(points.position, d)[p]         = point.x[d];
        points.data(points.initial_position, d)[p] = point.x[d];
        points.data(points.reference_length, d)[p] = point.length[d];
        points.data(points.stretch, d)[p]          = 1.;
        points.data(points.creation_stretch, d)[p] = 1.;
        points.data(points.deformation_gradient, d * (dim + 1))[p] = 1.;
      }
    points.data(points.reference_volume)[p] = volume;
    points.data(points.mass)[p]             = density * volume;
    points.data(points.body)[p]             = index;
  }



  /// Two bodies that overlap would put twice the mass into the same place,
  /// which no later check would notice. Looked at by the points there are, in
  /// the order of Bodies/Names. Each rank looks at its own: all know the shape.
  template <int dim>
  void
  Body<dim>::check_apart(const Region<dim> &region,
                         const Points<dim> &points) const
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto x = load_place(points, points.initial_position, p);
        AssertThrow(!region.contains(x),
                    ExcUser(text("The body '",
                                 name_,
                                 "' contains the point at (",
                                 x,
                                 ") m, which belongs to a body listed before "
                                 "it in Bodies/Names. Bodies must not "
                                 "overlap: move or reshape one of them.")));
      }
  }



  /// Contact with a surface that is already deep in the soil would throw it
  /// out. The half of a box that a centre may be off is none.
  template <int dim>
  void
  Body<dim>::check_clear_of(const Solids                     &solids,
                            const std::vector<NewPoint<dim>> &points) const
  {
    for (const Shape<dim> *solid : solids)
      for (const NewPoint<dim> &point : points)
        {
          const double depth = -solid->signed_distance(point.x);
          AssertThrow(depth <= 0.5 * point.length.norm(),
                      ExcUser(text("The point at (",
                                   point.x,
                                   ") m of the body '",
                                   name_,
                                   "' lies ",
                                   depth,
                                   " m inside of an obstacle. Set ",
                                   path("Cut by obstacles"),
                                   " = true, or move one of them.")));
        }
  }



  /// One number for all axes, or one for each.
  template <int dim>
  std::array<unsigned int, dim>
  Body<dim>::points_per_axis() const
  {
    AssertThrow(points_per_cell_.size() == 1 || points_per_cell_.size() == dim,
                ExcUser(text(path("Points per cell and axis"),
                             " lists ",
                             points_per_cell_.size(),
                             " numbers; give one, or one for each of the ",
                             dim,
                             " axes.")));
    std::array<unsigned int, dim> n;
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = points_per_cell_[points_per_cell_.size() == 1 ? 0 : d];
    return n;
  }



  namespace
  {
    /// Of all ranks, m^dim. Collective.
    template <int dim>
    double
    volume_of(const std::vector<NewPoint<dim>> &points,
              const MPI_Comm                    communicator)
    {
      double sum = 0.;
      for (const NewPoint<dim> &point : points)
        {
          double volume = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            volume *= point.length[d];
          sum += volume;
        }
      return Utilities::MPI::sum(sum, communicator);
    }
  } // namespace



  /// @p others are the points of the bodies before this one. What obstacles take
  /// is the difference to a filling without them, so that no volume is lost
  /// unseen, whatever the filling. Collective.
  template <int dim>
  typename Body<dim>::Places
  Body<dim>::places_of_points(const Grid<dim>   &grid,
                              const Solids      &solids,
                              const Points<dim> &others) const
  {
    const Box<dim>      &domain = grid.domain_before_growth();
    const auto           shape  = shape_.make(domain);
    const BoxRegion<dim> mesh(domain);
    const Box<dim> bounds = bounding_box(domain), box = shape->bounding_box();
    Region<dim>    region(*shape);
    // A shape without end must not reach into cells that were added far away.
    if (!(box.lower == bounds.lower && box.upper == bounds.upper))
      region.restrict_to(mesh);
    const auto fill = [&]() {
      return is_clipped()
               ? clipped_filling<dim>(grid, region, bounds, points_per_axis())
               : filling_by_centres<dim>(grid,
                                         region,
                                         bounds,
                                         points_per_axis());
    };
    const bool is_cut = cut_by_obstacles_ && !solids.empty();
    Places     result;
    if (is_cut)
      {
        result.uncut_volume = volume_of(fill(), grid.communicator());
        for (const Shape<dim> *solid : solids)
          region.cut_away(*solid);
      }
    check_apart(region, others);
    result.points = fill();
    if (is_cut)
      result.volume = volume_of(result.points, grid.communicator());
    else
      check_clear_of(solids, result.points);
    return result;
  }



  namespace
  {
    /// Empty if it is less than a millionth: where a body lies on an obstacle,
    /// the two surfaces differ by the error of their parts. Volumes in m^dim.
    template <int dim>
    std::string
    note_of_cut(const std::string &name, const double uncut, const double left)
    {
      const double lost = uncut - left;
      if (lost <= 1e-6 * uncut)
        return "";
      return text(std::setprecision(6),
                  "The obstacles take ",
                  lost,
                  dim == 2 ? " m^2" : " m^3",
                  " of the body '",
                  name,
                  "', ",
                  100. * lost / uncut,
                  " % of it: no soil is put into them.");
    }
  } // namespace



  namespace
  {
    /// Before memory runs out the user is told; points may be more in the end,
    /// and the mesh is not counted: what is refused here cannot work. Collective.
    template <int dim>
    void
    check_memory(const Grid<dim>   &grid,
                 const std::size_t  n_points_of_rank,
                 const std::string &body)
    {
      const double n_points =
        Utilities::MPI::sum(1. * n_points_of_rank, grid.communicator());
      const double bytes = n_points * bytes_per_point<dim> /
                           Utilities::MPI::n_mpi_processes(grid.communicator());
      AssertThrow(bytes < grid.memory_per_rank(),
                  ExcUser(text("With the body '",
                               body,
                               "' there would be ",
                               n_points,
                               " points, which take some ",
                               bytes / 1e9,
                               " GB of memory on each rank, where ",
                               grid.memory_per_rank() / 1e9,
                               " GB are to be had. ",
                               fewer_points_advice)));
    }
  } // namespace



  template <int dim>
  std::string
  Body<dim>::create_points(const Grid<dim>   &grid,
                           const unsigned int index,
                           const double       density,
                           Points<dim>       &points,
                           const Solids      &solids) const
  {
    const Places places = places_of_points(grid, solids, points);
    check_memory(grid, points.size() + places.points.size(), name_);
    for (const NewPoint<dim> &place : places.points)
      add_point(points, index, place, density);
    // A rank may well have none, but one of them must have some.
    AssertThrow(Utilities::MPI::max(places.points.size(), grid.communicator()) >
                  0,
                ExcUser(text("The body '",
                             name_,
                             "' got no points: ",
                             is_clipped() ? "no part of its shape was found"
                                          : "no centre of a point lies in it",
                             cut_by_obstacles_ && !solids.empty()
                               ? " outside of the obstacles"
                               : "",
                             ". Make it larger than a cell (Grid/Cell size) "
                             "or raise ",
                             path("Points per cell and axis"),
                             ".")));
    return note_of_cut<dim>(name_, places.uncut_volume, places.volume);
  }



  template class Body<2>;
  template class Body<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/observers/obstacle_forces.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  ObstacleForces<dim>::ObstacleForces(FacetContact<dim> &contact)
    : QuantityTable<dim>("obstacles.csv")
    , contact_(contact)
  {}



  template <int dim>
  bool
  ObstacleForces<dim>::is_enabled(const OutputSettings & /*settings*/) const
  {
    return !contact_.obstacles().empty();
  }



  template <int dim>
  void
  ObstacleForces<dim>::list_forces(const unsigned int k, Quantities &row) const
  {
    const std::string &name = contact_.obstacles()[k].name();
    contact_.reactions()[k].list_quantities(name, row);
    append_vector<dim>(row,
                       name + " displacement",
                       "m",
                       contact_.obstacles()[k].displacement());
  }



  namespace
  {
    constexpr double smallest_depth = 0.1; ///< that counts as below, cells
  }



  // Nothing pushes points out that have come below a surface; so the user must
  // see how much soil has, and how deep. Points are held at the surface, and
  // their centres come to lie a hundredth of a cell below it: the volume of a
  // point counts where its centre is deeper than a tenth of a cell, as far as it
  // is below the surface, in full when its whole box is.
  template <int dim>
  void
  ObstacleForces<dim>::list_penetration(const unsigned int k,
                                        const State<dim>  &state,
                                        Quantities        &row) const
  {
    const Points<dim>   &points   = state.points;
    const Obstacle<dim> &obstacle = contact_.obstacles()[k];
    double               volume = 0, deepest = 0, in_cells = 0;
    for (const Segment &segment : points.segments())
      // Others are far from the surface.
      if (const Facets<dim> &facets = contact_.facets();
          facets.is_near(segment.cell) ||
          !facets.containing(segment.cell).empty())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            const auto [distance, normal] = obstacle.distance_and_normal(
              load_place(points, points.position, p));
            if (distance >= 0)
              continue;
            const double support =
              support_of_box(half_lengths_of_box(points, state.box_shape, p),
                             normal);
            const double v = points.data(points.reference_volume)[p] *
                             determinant(load_matrix<dim, double>(
                               points, points.deformation_gradient, p));
            const double depth =
              -distance / state.grid.cells()[segment.cell].size;
            if (depth > smallest_depth)
              volume += v * std::min(1., -distance / support);
            deepest  = std::max(deepest, -distance);
            in_cells = std::max(in_cells, depth);
          }
    const MPI_Comm    communicator = state.communicator();
    const std::string name         = obstacle.name() + ' ';
    row.push_back({name + "volume below surface",
                   dim == 2 ? "m^2" : "m^3",
                   Utilities::MPI::sum(volume, communicator)});
    row.push_back({name + "depth below surface",
                   "m",
                   Utilities::MPI::max(deepest, communicator)});
    row.push_back({name + "deepest point",
                   "cells",
                   Utilities::MPI::max(in_cells, communicator)});
  }



  template <int dim>
  Quantities
  ObstacleForces<dim>::evaluate(const State<dim> &state) const
  {
    Quantities row = {{"time", "s", state.time}};
    for (unsigned int k = 0; k < contact_.obstacles().size(); ++k)
      {
        list_forces(k, row);
        list_penetration(k, state, row);
      }
    return row;
  }



  template <int dim>
  void
  ObstacleForces<dim>::observe(const State<dim> &state)
  {
    QuantityTable<dim>::observe(state);
    contact_.start_interval();
  }



  /// Without obstacles there is no file, and nothing that a checkpoint would
  /// have to know of it.
  template <int dim>
  void
  ObstacleForces<dim>::list_state(StateList &list)
  {
    if (!contact_.obstacles().empty())
      TableObserver<dim>::list_state(list);
  }



  template class ObstacleForces<2>;
  template class ObstacleForces<3>;
} // namespace talus

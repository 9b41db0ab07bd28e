// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/obstacle_forces.h>

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



  // Nothing pushes points out that have come below a surface; so the user must
  // see how many have.
  template <int dim>
  void
  ObstacleForces<dim>::list_penetration(const unsigned int k,
                                        const State<dim>  &state,
                                        Quantities        &row) const
  {
    const Points<dim>   &points   = state.points;
    const Obstacle<dim> &obstacle = contact_.obstacles()[k];
    double               mass = 0, inside = 0, deepest = 0; // cells
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          const double m = points.data(points.mass)[p];
          mass += m;
          // Others are far from the surface.
          if (!contact_.facets().is_near(segment.cell))
            continue;
          const double distance =
            obstacle.signed_distance(load_place(points, points.position, p));
          if (distance < 0)
            inside += m;
          deepest = std::max(deepest,
                             -distance / state.grid.cells()[segment.cell].size);
        }
    const MPI_Comm communicator = state.communicator();
    mass                        = Utilities::MPI::sum(mass, communicator);
    inside                      = Utilities::MPI::sum(inside, communicator);
    const std::string name      = obstacle.name() + ' ';
    row.push_back({name + "share of mass below surface",
                   "-",
                   mass > 0 ? inside / mass : 0});
    row.push_back({name + "deepest point",
                   "cells",
                   Utilities::MPI::max(deepest, communicator)});
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

#ifndef talus_equilibrium_soil_h
#define talus_equilibrium_soil_h

#include <talus/boundaries/boundaries.h>
#include <talus/grid/nodal_fields.h>
#include <talus/materials/materials.h>
#include <talus/points/points.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  /// What is to be brought to equilibrium, and what acts on it. Points are
  /// sorted, and the nodes near them active.
  template <int dim>
  struct Soil
  {
    Points<dim>          &points;
    StepWorkspace<dim>   &workspace;
    const Grid<dim>      &grid;
    NodalFields<dim>     &nodes;
    const Transfer<dim>  &transfer;
    const Materials<dim> &materials;
    Boundaries<dim>      &boundaries;
    const Loads<dim>     &loads;
    double                time; ///< at which boundaries and loads are taken, s
    double                least_mass; ///< of a node that carries something, kg
  };



  /// Set mass, volume and force at the nodes to those of the explicit scheme:
  /// the force is what is not in balance before walls and seabed bear their
  /// share. Collective.
  template <int dim>
  inline void
  sum_forces(Soil<dim> &soil)
  {
    soil.nodes.clear();
    soil.points.for_batches([&](const Batch &batch) {
      soil.workspace.reinit(batch.begin, batch.end);
      soil.transfer.average_mean_stress(soil.points, soil.workspace, batch);
      soil.transfer.scatter(
        soil.points, soil.workspace, batch, soil.grid, soil.loads, soil.nodes);
    });
    soil.nodes.sum_over_ranks(soil.grid);
    soil.boundaries.add_tractions(soil.nodes,
                                  soil.grid,
                                  soil.time,
                                  soil.least_mass);
  }
} // namespace talus

#endif

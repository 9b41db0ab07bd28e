// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_background_mesh_h
#define talus_simulation_background_mesh_h

#include <talus/adaptivity/load_balance.h>
#include <talus/adaptivity/mesh_tracking.h>
#include <talus/base/phase_timer.h>
#include <talus/io/log.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>
#include <talus/transfer/relocation.h>
#include <talus/transfer/transfer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Mesh of a run over time, with the points in the cells: creates the mesh,
  /// adapts the mesh to the motion of the soil and distributes the cells over
  /// the ranks.
  ///
  /// Every change of the mesh or of the partition ends in prepare_nodes(), so
  /// start, resumed run and mesh change use the same code.
  template <int dim>
  class BackgroundMesh
  {
  public:
    /// All arguments must outlive the object.
    BackgroundMesh(State<dim>          &state,
                   Problem<dim>        &problem,
                   const Transfer<dim> &transfer,
                   PhaseTimer          &timer);

    /// Create the initial mesh for the bodies of the problem. @p log reports
    /// beforehand if the creation takes long.
    void
    create(Log &log);

    /// Create the mesh of a checkpoint and load the points. The partition is
    /// restored if the number of ranks is unchanged.
    ///
    /// @param path of the saved mesh
    /// @param n_ranks_then number of ranks that saved the mesh
    void
    load(const std::string &path, unsigned int n_ranks_then);

    /// Sort newly created points, at any position, into the cells.
    void
    insert_points();

    /// Redistribute the cells over the ranks, weighted by the points.
    /// Collective.
    void
    repartition();

    /// Adapt mesh and partition if due. Collective.
    void
    adapt();

    /// Sort the points after a step. The workspace lists the points that may
    /// have left the cell.
    void
    relocate();

    /// Weights of the owned cells at the last repartition [-].
    std::vector<double>
    cell_weights() const;

    /// Sentence describing the mesh and the number of points, for the log.
    /// Collective.
    std::string
    description() const;

    /// Sentences on the changes of mesh and partition so far, for the log.
    /// Collective.
    std::string
    history() const;

    void
    list_state(StateList &list);

  private:
    void
    prepare();
    void
    prepare_cells();
    void
    prepare_nodes();
    bool
    share_out();
    void
    activate_nodes();

    State<dim>          &state_;
    Problem<dim>        &problem_;
    const Transfer<dim> &transfer_;
    PhaseTimer          &timer_;
    MeshTracking<dim>    mesh_tracking_;
    LoadBalance<dim>     load_balance_;
    Relocation<dim>      relocation_;
    unsigned long        n_mesh_changes_ = 0;
    unsigned long        n_repartitions_ = 0;
  };
} // namespace talus

#endif

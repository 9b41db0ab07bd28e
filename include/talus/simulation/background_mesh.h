// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_background_mesh_h
#define talus_simulation_background_mesh_h

#include <talus/adaptivity/load_balance.h>
#include <talus/adaptivity/mesh_tracking.h>
#include <talus/base/phase_timer.h>
#include <talus/checkpoint/checkpoint_content.h>
#include <talus/io/log.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>
#include <talus/transfer/relocation.h>
#include <talus/transfer/transfer.h>

#include <string>
#include <vector>

namespace talus
{
  /// The mesh of a run over time: made, changed where the soil goes, shared out
  /// among the ranks; and the points in its cells.
  ///
  /// Whatever changes the mesh or its partition ends in prepare_nodes(), so that
  /// start, resumed run and change of the mesh go the same way.
  template <int dim>
  class BackgroundMesh
  {
  public:
    BackgroundMesh(State<dim>          &state,
                   Problem<dim>        &problem,
                   const Transfer<dim> &transfer,
                   PhaseTimer          &timer);

    /// Make the mesh that the parameters ask for, around the bodies to be. If
    /// that takes long, @p log says so before.
    void
    create(Log &log);

    /// Make the mesh of a checkpoint, with its partition on as many ranks as
    /// then, and load its points.
    void
    load(const std::string    &mesh,
         Hdf5InputFile        &file,
         const CheckpointHead &head);

    /// Sort in points that were just made, anywhere.
    void
    insert_points();

    /// Share the cells out anew among the ranks, by their points.
    void
    repartition();

    /// Change mesh and partition if it is time to. Collective.
    void
    adapt();

    /// Sort the points after a step that noted in the workspace which of them
    /// may have left their cell.
    void
    relocate();

    /// Sort the points after all of them may have moved, farther than to a
    /// neighbouring cell. Collective.
    void
    relocate_all();

    /// Weights of the owned cells at the last repartition.
    std::vector<double>
    cell_weights() const;

    /// Sentence that describes the mesh and the number of points.
    std::string
    description() const;

    /// Sentences on what became of mesh and partition so far.
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
    restore_partition(Hdf5InputFile &file);
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

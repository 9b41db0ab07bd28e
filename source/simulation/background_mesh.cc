// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/background_mesh.h>
#include <talus/transfer/send_to_owners.h>
#include <talus/transfer/weights.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Coverage and reach, after a change of the mesh: every point lies in its
    /// cell, or beyond a wall at most half a cell outside, and its weights sum
    /// to one (which weights_of_point() asserts). (Used in Debug only.)
    template <int dim>
    [[maybe_unused]] bool
    points_are_covered(const State<dim> &state)
    {
      const Points<dim>           &points = state.points;
      const Grid<dim>             &grid   = state.grid;
      std::vector<NodeWeight<dim>> weights;
      for (const Segment &segment : points.segments())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            const Cell<dim> &cell = grid.cells()[segment.cell];
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double xi =
                  (points.data(points.position, d)[p] - cell.lower[d]) /
                  cell.size;
                // At walls, and the seabed, centres may dip half a cell.
                const bool first = cell.lower[d] <= grid.domain().lower[d];
                const bool last =
                  cell.lower[d] + 1.5 * cell.size > grid.domain().upper[d];
                if (!(xi >= (first ? -0.5 : -1e-12) &&
                      xi <= (last ? 1.5 : 1. + 1e-12)))
                  return false;
              }
            weights_of_point(points,
                             grid,
                             state.constants.box_shape,
                             segment.cell,
                             p,
                             weights);
          }
      return state.constants.box_shape.most_half <= 0.5;
    }
  } // namespace



  template <int dim>
  BackgroundMesh<dim>::BackgroundMesh(State<dim>          &state,
                                      Problem<dim>        &problem,
                                      const Transfer<dim> &transfer,
                                      PhaseTimer          &timer)
    : state_(state)
    , problem_(problem)
    , transfer_(transfer)
    , timer_(timer)
  {}



  namespace
  {
    /// Cells of a mesh that is as fine everywhere as its base level.
    template <int dim>
    double
    n_cells_of_base_level(const Grid<dim> &grid)
    {
      double n_cells = 1;
      for (const long n : grid.extent_of_lattice(grid.base_level()))
        n_cells *= n;
      return n_cells;
    }
  } // namespace



  /// Without points, which need cells to be put into. With mesh tracking the
  /// cells are fine where the bodies will be, known by their boxes.
  template <int dim>
  void
  BackgroundMesh<dim>::create(Log &log)
  {
    // Some seconds of one core.
    constexpr double n_cells_that_take_long = 1e6;
    Grid<dim>       &grid                   = state_.grid;
    grid.create(problem_.faces_that_may_move(),
                mesh_tracking_.is_enabled(),
                problem_.boundaries.periodic_axes());
    const double n_cells = n_cells_of_base_level(grid);
    if (!mesh_tracking_.is_enabled() && n_cells > n_cells_that_take_long)
      log.say(LogLevel::result,
              text(std::setprecision(3),
                   "A mesh of at least ",
                   n_cells,
                   " cells is being made."));
    if (mesh_tracking_.is_enabled())
      mesh_tracking_.adapt(
        grid, problem_.bounding_boxes(grid.domain_before_growth()));
    else
      grid.refine();
    prepare();
  }



  /// The mesh is that of the checkpoint, on as many ranks as there are now. The
  /// partition, if the ranks are as many; then the points, whose cells were
  /// saved with them. A point on an edge could be found in either cell, and the
  /// order of sums would change. From prepare() on all is as after any change
  /// of the mesh. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::load(const std::string    &mesh,
                            Hdf5InputFile        &file,
                            const CheckpointHead &head)
  {
    Grid<dim>         &grid = state_.grid;
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(state_.communicator());
    grid.create(problem_.faces_that_may_move(),
                mesh_tracking_.is_enabled(),
                problem_.boundaries.periodic_axes());
    grid.load(mesh);
    if (n_ranks == head.n_ranks && n_ranks > 1)
      restore_partition(file);
    prepare();
    // Not found by their positions: on an edge of a cell these leave a choice.
    relocation_.rebuild(state_.points,
                        load_points(file, grid.n_owned_cells(), state_.points));
    activate_nodes();
  }



  /// p4est has shared the cells evenly; the sums over ranks are bit by bit the
  /// same only if every rank has what it had.
  /// Twice: the weights of the cells that the rank has now decide what it gets,
  /// and then those of what it got are the state that load_balance_ keeps.
  template <int dim>
  void
  BackgroundMesh<dim>::restore_partition(Hdf5InputFile &file)
  {
    const auto weights = [&]() {
      const auto result =
        load_cell_weights(file, state_.grid.n_locally_owned_cells());
      check_read(file);
      return result;
    };
    state_.grid.repartition(weights());
    load_balance_.set_weights(weights());
  }



  /// All that depends on the mesh. Points stay on their rank. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare()
  {
    prepare_cells();
    prepare_nodes();
  }



  /// With these and prepare_nodes() all caches that follow from the mesh are
  /// made, so that start, resumed run and change of the mesh cannot differ.
  /// Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare_cells()
  {
    // In cells. Through a free face a point leaves the mesh, which is an error
    // where the face is not one of outflow.
    std::array<double, 2 * dim> may_lie_outside;
    std::array<bool, 2 * dim>   is_outflow;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        may_lie_outside[face] = (problem_.boundaries.is_free(face) ? 0. : 0.5);
        is_outflow[face]      = problem_.boundaries.is_outflow(face);
      }
    relocation_.allow_outside(may_lie_outside);
    state_.outflow.open(is_outflow);
    if (state_.outflow.is_open())
      state_.accounts.open_stored_energy("outflow energy",
                                         [this](const Points<dim> &) {
                                           return state_.outflow.energy();
                                         });

    state_.grid.prepare();
    relocation_.rebuild(state_.points, state_.grid);
  }



  /// Numbers of nodes change with the cells, so boundaries find theirs anew.
  /// Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare_nodes()
  {
    state_.nodes.prepare(state_.grid);
    problem_.locate(state_.grid);
    activate_nodes();
    // Of the smallest cell, so that the same nodes carry motion at any level.
    state_.constants.mass_cutoff =
      transfer_.mass_cutoff(problem_.least_density(),
                            state_.grid.finest_size());
  }



  /// The points are in their new cells.
  template <int dim>
  void
  BackgroundMesh<dim>::activate_nodes()
  {
    state_.nodes.activate(state_.grid, relocation_.occupied_cells());
    Assert(points_are_covered(state_),
           ExcMessage(
             "After a change of the mesh a point is not in its cell."));
  }



  /// For points that lie anywhere in this rank's cells, as new ones do.
  template <int dim>
  void
  BackgroundMesh<dim>::insert_points()
  {
    relocation_.update(state_.points, state_.grid);
    state_.nodes.activate(state_.grid, relocation_.occupied_cells());
  }



  /// Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::repartition()
  {
    if (share_out())
      prepare_nodes();
  }



  /// Cells and points travel together. Relocation gets the cells from those who
  /// sent the points and need not search. Returns whether there is more than one
  /// rank. Collective.
  template <int dim>
  bool
  BackgroundMesh<dim>::share_out()
  {
    if (Utilities::MPI::n_mpi_processes(state_.communicator()) == 1)
      return false;
    ++n_repartitions_;
    const auto cells = load_balance_.repartition(state_.grid, state_.points);
    relocation_.rebuild(state_.points, cells);
    return true;
  }



  /// In front of the step, while points are in cells that they may still touch.
  /// Two questions of different price: whether the mesh is due, by the step, is
  /// known to each rank alone; whether it is urgent, since a point could reach
  /// a larger cell in the next step, is asked of all ranks, by one message. A
  /// new mesh is shared out anew at once, as its cells may all be on few ranks.
  /// Load is looked at every some steps only. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::adapt()
  {
    PhaseTimer::Scope scope(timer_, "mesh");
    const MPI_Comm    communicator = state_.communicator();
    const auto       &occupied     = relocation_.occupied_cells();
    if (mesh_tracking_.is_enabled() &&
        (mesh_tracking_.is_due(state_.step) ||
         Utilities::MPI::logical_or(
           mesh_tracking_.is_urgent(state_.grid, occupied), communicator)))
      if (mesh_tracking_.adapt(state_.grid, occupied))
        {
          ++n_mesh_changes_;
          prepare_cells();
          share_out();
          prepare_nodes();
        }
    if (load_balance_.is_due(state_.step, communicator) &&
        load_balance_.is_needed(state_.points, communicator))
      repartition();
  }



  /// The gather has listed the points that left their cell, so that only those
  /// are looked at. Nodes are activated anew only if other cells have points
  /// now. Points travel between neighbours; collective.
  template <int dim>
  void
  BackgroundMesh<dim>::relocate()
  {
    PhaseTimer::Scope  scope(timer_, "relocation");
    const Points<dim> &points = state_.points;
    const auto         leaves = [&](const unsigned int p) {
      if (!state_.outflow.is_beyond(load_place(points, points.position, p),
                                    state_.grid.domain()))
        return false;
      state_.outflow.record(points, p, state_.constants.added_mass);
      return true;
    };
    if (relocation_.update_points_out_of_cell(
          state_.points,
          state_.grid,
          state_.workspace.points_out_of_cell(),
          state_.outflow.is_open() ? typename Relocation<dim>::Leaves(leaves)
                                   : nullptr))
      state_.nodes.activate(state_.grid, relocation_.occupied_cells());
  }



  /// In a load step of large strain points may move farther than into a
  /// neighbour cell, so each is searched for, and may go to any rank.
  /// Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::relocate_all()
  {
    if (Utilities::MPI::n_mpi_processes(state_.communicator()) > 1)
      {
        state_.points.forget_order();
        send_points_to_owners(state_.points, state_.grid);
      }
    if (relocation_.update(state_.points, state_.grid))
      state_.nodes.activate(state_.grid, relocation_.occupied_cells());
  }



  /// Never shared out, all cells weigh the same.
  template <int dim>
  std::vector<double>
  BackgroundMesh<dim>::cell_weights() const
  {
    std::vector<double> weights = load_balance_.weights();
    weights.resize(state_.grid.n_owned_cells(), 1.);
    return weights;
  }



  /// A sentence for the log. Collective.
  template <int dim>
  std::string
  BackgroundMesh<dim>::description() const
  {
    const Grid<dim> &grid = state_.grid;
    const bool       is_uniform =
      (n_cells_of_base_level(grid) == grid.n_global_cells());
    return text("The mesh fills (",
                grid.domain().lower,
                ") to (",
                grid.domain().upper,
                ") m with ",
                grid.n_global_cells(),
                " cells",
                is_uniform ? " of " : ", the smallest of ",
                grid.finest_size(),
                " m; there are ",
                Utilities::MPI::sum(state_.points.size(),
                                    state_.communicator()),
                " points.",
                grid.adjustment());
  }



  /// What became of the mesh so far, for the log. Collective.
  template <int dim>
  std::string
  BackgroundMesh<dim>::history() const
  {
    const MPI_Comm     communicator = state_.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    std::string        sentence;
    if (n_mesh_changes_ > 0)
      sentence += text(" The mesh changed ",
                       n_mesh_changes_,
                       " times and has ",
                       state_.grid.n_global_cells(),
                       " cells.");
    if (n_ranks > 1)
      sentence += text(std::setprecision(6),
                       " The largest share of points of the ",
                       n_ranks,
                       " ranks is ",
                       LoadBalance<dim>::imbalance(state_.points, communicator),
                       " times the mean; cells were shared out ",
                       n_repartitions_,
                       " times.");
    return sentence;
  }



  template <int dim>
  void
  BackgroundMesh<dim>::list_state(StateList &list)
  {
    list.add("mesh changes", "-", n_mesh_changes_, Reduction::equal);
    list.add("repartitions", "-", n_repartitions_, Reduction::equal);
    load_balance_.list_state(list);
  }



  template class BackgroundMesh<2>;
  template class BackgroundMesh<3>;
} // namespace talus

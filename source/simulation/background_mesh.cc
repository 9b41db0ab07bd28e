// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/problem/filling.h>
#include <talus/simulation/background_mesh.h>
#include <talus/transfer/points_of_cells.h>
#include <talus/transfer/send_to_owners.h>
#include <talus/transfer/weights.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Check coverage and reach after a change of the mesh: every point lies in
    /// its cell, or beyond a wall by at most half a cell, and the weights of a
    /// point sum to one (asserted by weights_of_point()). (Used in Debug only.)
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
                // At walls, and at the seabed, centres may be half a cell
                // outside.
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
      return true;
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
    /// Number of cells of a mesh uniformly refined to the base level.
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



  namespace
  {
    /// Return boxes around the soil of @p bodies.
    template <int dim>
    std::vector<Box<dim>>
    boxes_around_soil(const Bodies<dim> &bodies, const Grid<dim> &grid)
    {
      const Box<dim>        domain = grid.domain_before_growth();
      std::vector<Box<dim>> result;
      for (const auto &body : bodies.list())
        {
          const auto            shape = body->shape(domain);
          std::vector<Box<dim>> boxes{body->bounding_box(domain)};
          // A search in more than about 1e5 boxes would take too long.
          double volume = 1e-5;
          for (unsigned int d = 0; d < dim; ++d)
            volume *= boxes[0].length(d);
          const double size =
            std::max(4. * grid.cell_size(), std::pow(volume, 1. / dim));
          // Displaced points may be anywhere around.
          if (!body->initial_state().is_displaced())
            if (const auto with_soil =
                  boxes_with_soil(Region<dim>(*shape), boxes[0], size);
                !with_soil.empty())
              boxes = with_soil;
          result.insert(result.end(), boxes.begin(), boxes.end());
        }
      return result;
    }
  } // namespace



  /// The mesh is created without points, because points need cells. With mesh
  /// tracking the cells are fine around the bodies.
  template <int dim>
  void
  BackgroundMesh<dim>::create(Log &log)
  {
    // Takes some seconds on one core.
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
      mesh_tracking_.adapt(grid, boxes_around_soil(problem_.bodies(), grid));
    else
      grid.refine();
    prepare();
  }



  /// Points are loaded with the saved cells: a point on an edge could be found
  /// in either cell, and the order of sums would change. p4est distributes the
  /// cells evenly, but sums over ranks are bit-identical only if every rank has
  /// its previous cells and points: the saved weights of the cells repeat the
  /// partition. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::load(const std::string &path,
                            const unsigned int n_ranks_then)
  {
    Grid<dim>         &grid   = state_.grid;
    Points<dim>       &points = state_.points;
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(state_.communicator());
    grid.create(problem_.faces_that_may_move(),
                mesh_tracking_.is_enabled(),
                problem_.boundaries.periodic_axes());
    grid.load(path);
    prepare_cells();
    std::vector<double> weights;
    relocation_.rebuild(points, load_points(grid, points, weights));
    if (n_ranks == n_ranks_then && n_ranks > 1)
      relocation_.rebuild(points,
                          load_balance_.repartition(grid, points, weights));
    prepare_nodes();
  }



  /// Prepare everything that depends on the mesh. Points stay on their rank.
  /// Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare()
  {
    prepare_cells();
    prepare_nodes();
  }



  /// Together with prepare_nodes() rebuilds all caches derived from the mesh,
  /// so start, resumed run and mesh change cannot differ. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare_cells()
  {
    // Distances in cells. A point leaves the mesh through a free face, which is
    // an error unless the face is an outflow face.
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



  /// The numbering of nodes changes with the cells, so boundaries search their
  /// nodes again. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::prepare_nodes()
  {
    state_.nodes.prepare(state_.grid);
    problem_.locate(state_.grid);
    activate_nodes();
    // Uses the smallest cell, so that the same nodes carry motion at any level.
    state_.constants.mass_cutoff =
      transfer_.mass_cutoff(problem_.min_density(), state_.grid.finest_size());
  }



  /// Activate the nodes of occupied cells; all points must be in their new
  /// cells.
  template <int dim>
  void
  BackgroundMesh<dim>::activate_nodes()
  {
    state_.nodes.activate(state_.grid, relocation_.occupied_cells());
    TalusAssert(points_are_covered(state_),
                ExcMessage(
                  "After a change of the mesh a point is not in its cell."));
  }



  /// Points may be anywhere in the cells of the rank, such as new points.
  template <int dim>
  void
  BackgroundMesh<dim>::insert_points()
  {
    relocation_.update(state_.points, state_.grid);
    state_.nodes.activate(state_.grid, relocation_.occupied_cells());
  }



  template <int dim>
  void
  BackgroundMesh<dim>::repartition()
  {
    if (share_out())
      prepare_nodes();
  }



  /// Cells and points are sent together. The sender also provides the cell of
  /// each point, so relocation needs no search. Returns whether there is more
  /// than one rank. Collective.
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



  /// Called before the step, while points are in cells that they may still
  /// touch. Whether the mesh is due depends on the step number, known to each
  /// rank without communication. Whether a change is urgent, because a point
  /// could reach a larger cell in the next step, needs a message of all ranks.
  /// A new mesh is repartitioned immediately, because all new cells may be on
  /// few ranks. The load is checked only every few steps. Collective.
  template <int dim>
  void
  BackgroundMesh<dim>::adapt()
  {
    PhaseTimer::Scope scope(timer_, "mesh");
    const MPI_Comm    communicator = state_.communicator();
    const auto       &occupied     = relocation_.occupied_cells();
    if (mesh_tracking_.is_enabled())
      if (const bool is_urgent = Utilities::MPI::logical_or(
            mesh_tracking_.is_urgent(state_.grid, occupied), communicator);
          (is_urgent || mesh_tracking_.is_due(state_.step)) &&
          mesh_tracking_.adapt(state_.grid, occupied, is_urgent))
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



  /// Only the points that left their cell, listed by the gather, are checked.
  /// Nodes are activated again only if the set of occupied cells has changed.
  /// Points are sent between neighbouring ranks. Collective.
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



  /// Before the first repartition all cells have weight 1.
  template <int dim>
  std::vector<double>
  BackgroundMesh<dim>::cell_weights() const
  {
    std::vector<double> weights = load_balance_.weights();
    weights.resize(state_.grid.n_owned_cells(), 1.);
    return weights;
  }



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
                counted(grid.n_global_cells(), "cell"),
                is_uniform ? " of " : ", the smallest of ",
                grid.finest_size(),
                " m, and with ",
                counted(Utilities::MPI::sum(state_.points.size(),
                                            state_.communicator()),
                        "point"),
                ".",
                grid.adjustment());
  }



  template <int dim>
  std::string
  BackgroundMesh<dim>::history() const
  {
    const MPI_Comm     communicator = state_.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    std::string        sentence;
    if (n_mesh_changes_ > 0)
      sentence += text(" The mesh changed ",
                       counted(n_mesh_changes_, "time"),
                       " and has ",
                       counted(state_.grid.n_global_cells(), "cell"),
                       ".");
    if (n_ranks > 1)
      sentence += text(std::setprecision(6),
                       " The largest share of points of the ",
                       n_ranks,
                       " ranks is ",
                       LoadBalance<dim>::imbalance(state_.points, communicator),
                       " times the mean; cells were shared out ",
                       counted(n_repartitions_, "time"),
                       ".");
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/simulation/explicit_scheme.h>
#include <talus/simulation/null_space_filter.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/edge_reduction.h>
#include <talus/transfer/film.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <type_traits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Sum of value(0) ... value(n - 1). The round-off of one running sum of
    /// 10^6 terms reaches 1e-12; four sums per block are faster, too.
    template <typename Value>
    double
    sum_by_blocks(const unsigned int n, const Value &value)
    {
      constexpr unsigned int block = 1024;
      double                 total = 0;
      unsigned int           i     = 0;
      while (i + 4 <= n)
        {
          std::array<double, 4> sums{};
          for (const unsigned int end = std::min(i + block, n); i + 4 <= end;
               i += 4)
            for (unsigned int k = 0; k < 4; ++k)
              sums[k] += value(i + k);
          total += (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }
      for (; i < n; ++i)
        total += value(i);
      return total;
    }



    /// Whether the nodes carry the mass of all points: the weights of every
    /// point sum to one. (Used by assertions only.)
    template <int dim>
    [[maybe_unused]] bool
    nodes_carry_all_mass(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      const double      *mass   = points.data(points.mass);
      const double       of_points =
        Utilities::MPI::sum(sum_by_blocks(points.size(),
                                          [&](const unsigned int p) {
                                            return mass[p];
                                          }),
                            state.communicator());
      const auto  &nodes = state.nodes.active_nodes();
      const double of_nodes =
        Utilities::MPI::sum(sum_by_blocks(nodes.size(),
                                          [&](const unsigned int i) {
                                            return state.nodes.mass(nodes[i]);
                                          }),
                            state.communicator());
      return std::abs(of_nodes - of_points) <= 1e-12 * of_points;
    }



    /// Work per time on the points of a batch, W, of excess pore pressure that
    /// the points do not store, since water flows or cavitates; before the step
    /// changes their volumes: the work of the nodal forces.
    template <int dim>
    double
    power_of_pore_pressure(const Points<dim>        &points,
                           const Materials<dim>     &materials,
                           const StepWorkspace<dim> &workspace,
                           const Batch              &batch)
    {
      const double *const u   = points.data(points.pore_pressure());
      double              sum = 0;
      materials.for_each_material_range(
        points,
        batch,
        [&](const MaterialModel<dim> &model,
            const unsigned int        begin,
            const unsigned int        end) {
          const WaterResponse<dim> water = model.pore_water();
          for (unsigned int p = begin; p < end; ++p)
            if (water.stiffness == 0. || u[p] <= -water.largest_suction)
              {
                double rate = 0;
                for (unsigned int d = 0; d < dim; ++d)
                  rate += workspace.velocity_gradient(d, d)[p - batch.begin];
                sum += u[p] * rate * volume_of_points<dim, double>(points, p);
              }
        });
      return sum;
    }



    /// Largest norm of the velocity gradient of the points of a batch, 1/s.
    template <int dim>
    double
    largest_gradient(const StepWorkspace<dim> &workspace, const Batch &batch)
    {
      Simd<simd_width> largest(0.);
      Simd<1>          of_rest(0.);
      for_each_simd(0,
                    batch.end - batch.begin,
                    [&](const unsigned int k, auto number) TALUS_INLINE_LAMBDA {
                      using Number = decltype(number);
                      Number square(0.);
                      for (unsigned int i = 0; i < dim; ++i)
                        for (unsigned int j = 0; j < dim; ++j)
                          {
                            const auto L = load<Number>(
                              workspace.velocity_gradient(i, j) + k);
                            square += L * L;
                          }
                      if constexpr (std::is_same_v<Number, Simd<1>>)
                        of_rest = max(of_rest, square);
                      else
                        largest = max(largest, square);
                    });
      double result = of_rest[0];
      for (unsigned int n = 0; n < simd_width; ++n)
        result = std::max(result, largest[n]);
      return std::sqrt(result);
    }
  } // namespace



  template <int dim>
  ExplicitScheme<dim>::ExplicitScheme(State<dim>          &state,
                                      Problem<dim>        &problem,
                                      const Transfer<dim> &transfer,
                                      BackgroundMesh<dim> &mesh,
                                      PhaseTimer          &timer)
    : state_(state)
    , problem_(problem)
    , transfer_(transfer)
    , mesh_(mesh)
    , timer_(timer)
    , confinement_(problem.obstacles, problem.contact.facets())
    , inflow_(state, problem, splitter_)
  {}



  /// One step of the update-stress-last scheme; formulas in doc/method.md,
  /// section 2. Positions and stresses go from t to t + dt, velocities from t -
  /// dt/2 to t + dt/2. Reasons for the order: the mesh changes first, while all
  /// points are in their cells. The ranks agree on the time step before a point
  /// moves. Points split after they have moved and before they are relocated,
  /// so that children find their cells together with all other points.
  template <int dim>
  RunRequest
  ExplicitScheme<dim>::advance(const double end_time, const RunRequest own)
  {
    mesh_.adapt();
    merge();
    filter();
    points_to_grid();
    const RunRequest request = agree_on_step(end_time, own);
    update_nodes();
    grid_to_points();
    split();
    inflow_.feed();
    mesh_.relocate(); // with children, which may lie in other cells
    state_.time += state_.time_step;
    ++state_.step;
    return request;
  }



  template <int dim>
  void
  ExplicitScheme<dim>::merge()
  {
    if (!merger_.is_due(state_.step))
      return;
    PhaseTimer::Scope scope(timer_, "merging");
    merger_.apply(state_, splitter_, problem_.materials);
  }



  template <int dim>
  void
  ExplicitScheme<dim>::filter()
  {
    if (!transfer_.scheme().filters(state_.step))
      return;
    PhaseTimer::Scope scope(timer_, "filter");
    filter_null_space(state_,
                      problem_.materials,
                      transfer_,
                      &problem_.boundaries);
  }



  /// A step has two sweeps over the points, here and in grid_to_points(), batch
  /// by batch, so that the data of a point come from memory once per sweep. The
  /// first sweep also computes the time step: a separate sweep would read the
  /// points a third time. The workspace holds the results of a phase for the
  /// next phase; it is as large as a batch and stays in the cache.
  template <int dim>
  void
  ExplicitScheme<dim>::points_to_grid()
  {
    timer_.start_laps();
    problem_.loading.update(state_.points, state_.time);
    state_.nodes.clear();
    timer_.lap(PhaseTimer::points_to_grid);
    time_step_.begin(state_.max_velocity_gradient);
    groups_.clear();
    state_.points.for_each_batch([this](const Batch &batch) {
      state_.workspace.reinit(batch.begin, batch.end);
      time_step_.add_batch(state_.points,
                           batch,
                           state_.grid,
                           problem_.materials,
                           transfer_.box_shape());
      timer_.lap(PhaseTimer::time_step);
      transfer_.apply_bbar_to_stress(state_.points, state_.workspace, batch);
      transfer_.scatter(state_.with(problem_.loading.loads()), batch, &groups_);
      timer_.lap(PhaseTimer::points_to_grid);
    });
  }



  /// Agree with all ranks, in one message per step, on the time step and on the
  /// request for the time after the step (checkpoint, stop). The message also
  /// counts the points, which would otherwise need a second message. The last
  /// step is shortened to end at the end time.
  template <int dim>
  RunRequest
  ExplicitScheme<dim>::agree_on_step(const double     end_time,
                                     const RunRequest own)
  {
    PhaseTimer::Scope scope(timer_, "messages");
    const StepPlan    plan =
      agreement_.agree({time_step_.stable_time_step(state_.points,
                                                    problem_.materials),
                        own,
                        1. * state_.points.size(),
                        time_step_.max_speed()},
                       state_.communicator());
    splitter_.check_total(plan.n_points, state_.points.size());
    state_.time_step = std::min(plan.time_step, end_time - state_.time);
    state_.max_path += state_.time_step * plan.max_speed;
    // All ranks have the same step: all or none of them ask for the limiting
    // condition.
    check_time_advances(state_.time, state_.time_step, [this]() {
      return time_step_.limited_by(state_.points,
                                   state_.grid,
                                   problem_.materials,
                                   transfer_.box_shape());
    });
    return plan.request;
  }



  /// Update the nodes. Sums at the nodes are complete after the first message,
  /// velocities of ghosts after the second.
  template <int dim>
  void
  ExplicitScheme<dim>::update_nodes()
  {
    const auto in_phase = [this](const char *phase, const auto &action) {
      PhaseTimer::Scope scope(timer_, phase);
      action();
    };
    NodalInteractions<dim> &interactions = problem_.interactions;
    in_phase("messages", [&]() {
      state_.nodes.sum_over_ranks(state_.grid);
      if (splitter_.is_enabled())
        state_.nodes.share_volumes();
    });
    TalusAssert(nodes_carry_all_mass(state_),
                ExcMessage(
                  "The nodes do not carry all mass of the points: a box "
                  "reaches beyond the cells around its own."));
    in_phase("nodal update", [&]() {
      interactions.begin_step(state_);
      interactions.add_forces(state_);
      state_.nodes.update_momentum(state_.time_step,
                                   state_.constants.mass_cutoff);
    });
    in_phase("boundaries", [&]() { interactions.correct_velocities(state_); });
    in_phase("messages",
             [&]() { state_.nodes.share_with_ghosts(state_.grid); });
    in_phase("boundaries", [&]() { interactions.record(state_); });
  }



  /// Second sweep: a batch in the cache is moved and strained, gets new
  /// stresses, and is examined for splits. B-bar needs all points of a cell, so
  /// batches end between cells.
  template <int dim>
  void
  ExplicitScheme<dim>::grid_to_points()
  {
    timer_.start_laps();
    const double dt = state_.time_step;
    // Before the sweep, because there is nearly always nothing to do.
    problem_.trigger.update(state_.points,
                            problem_.materials.strength_factor(),
                            state_.time,
                            state_.time + dt);
    change_pore_pressure();
    groups_.rewind();
    state_.max_velocity_gradient = 0;
    const auto rule              = transfer_.box_shape().rule;
    double    &gravity_work      = state_.accounts.energy("gravity work");
    state_.points.for_each_batch([&](const Batch &batch) {
      state_.workspace.reinit(batch.begin, batch.end);
      confinement_.note(state_, batch);
      gravity_work += transfer_.gather(state_.with(problem_.loading.loads()),
                                       batch,
                                       dt,
                                       &groups_);
      confinement_.confine(state_);
      transfer_.apply_bbar_to_dilatation(state_.points,
                                         state_.workspace,
                                         batch);
      state_.max_velocity_gradient =
        std::max(state_.max_velocity_gradient,
                 largest_gradient(state_.workspace, batch));
      if (state_.points.have_pore_pressure())
        state_.accounts.energy("pore pressure work") +=
          dt * power_of_pore_pressure(state_.points,
                                      problem_.materials,
                                      state_.workspace,
                                      batch);
      timer_.lap(PhaseTimer::grid_to_points);
      problem_.materials.set_cell_sizes(state_.points,
                                        batch,
                                        [&](const unsigned int cell) {
                                          return state_.grid.cells()[cell].size;
                                        });
      problem_.materials.update_stress(state_.points,
                                       state_.workspace,
                                       batch,
                                       dt);
      reduce_edges(batch);
      update_box_lengths(state_.points, batch.begin, batch.end, rule);
      timer_.lap(PhaseTimer::stress_update);
      splitter_.mark(state_.points, batch, state_.grid);
      timer_.lap(PhaseTimer::splitting);
    });
  }



  /// The change brings energy to water that cannot flow.
  template <int dim>
  void
  ExplicitScheme<dim>::change_pore_pressure()
  {
    const double after = state_.time + state_.time_step;
    if (!problem_.pore_pressure.changes(state_.time, after))
      return;
    double &work = state_.accounts.energy("pore pressure work");
    work -= problem_.materials.water_energy(state_.points);
    problem_.pore_pressure.update(state_.points, state_.time, after);
    work += problem_.materials.water_energy(state_.points);
  }



  /// Reduce the edges of all points but those of hyperelastic laws: an elastic
  /// body is sheared within limits, and neighbours in such a body keep edges
  /// that fit together.
  template <int dim>
  void
  ExplicitScheme<dim>::reduce_edges(const Batch &batch)
  {
    // Points of a cell ask one after the other.
    unsigned int             known = numbers::invalid_unsigned_int;
    std::optional<Film<dim>> film;
    const auto               film_at = [&](const unsigned int p) {
      const unsigned int cell = state_.points.cell_of(p);
      if (known != cell)
        {
          const auto [begin, end] = state_.points.range_of_cell(p);
          known                   = cell;
          film                    = std::nullopt;
          // In 2-D only the presence of a film counts.
          if (is_film(state_.grid.cells()[cell], state_.nodes))
            film = dim == 3 ? film_of(state_.points, begin, end) : Film<dim>();
        }
      return film;
    };
    problem_.materials.for_each_material_range(
      state_.points,
      batch,
      [&](const MaterialModel<dim> &model,
          const unsigned int        begin,
          const unsigned int        end) {
        if (!model.is_hyperelastic())
          talus::reduce_edges<dim>(state_.points,
                                   begin,
                                   end,
                                   transfer_.box_shape().counts_shear,
                                   film_at);
      });
  }



  /// Split the points that grid_to_points() marked. Adds the children to the
  /// points out of their cell.
  template <int dim>
  void
  ExplicitScheme<dim>::split()
  {
    PhaseTimer::Scope scope(timer_, "splitting");
    splitter_.split_marked(state_.points,
                           state_.workspace.points_out_of_cell());
  }



  /// Stable time step of the present state, for set-up and log only.
  /// Collective.
  template <int dim>
  double
  ExplicitScheme<dim>::stable_time_step()
  {
    return Utilities::MPI::min(time_step_.choose(state_.points,
                                                 state_.grid,
                                                 problem_.materials,
                                                 transfer_.box_shape()),
                               state_.communicator());
  }



  // A run that cannot end in months has a wrong unit somewhere. The splitter
  // would report too many points only in the first step, when the results of an
  // earlier run are gone.
  template <int dim>
  void
  ExplicitScheme<dim>::check_effort(const double end_time)
  {
    const double dt      = stable_time_step();
    const double n_steps = (end_time - state_.time) / dt;
    AssertThrow(n_steps <= 1e12,
                ExcUser(text(std::setprecision(6),
                             "The run would take ",
                             n_steps,
                             " time steps of ",
                             dt,
                             " s to 'End time' = ",
                             end_time,
                             " s and cannot end. Check the units of "
                             "stiffness, density, cell size, velocities and "
                             "'End time', and 'Time step/Maximum'.")));
    const double n_points =
      Utilities::MPI::sum(1. * state_.points.size(), state_.communicator());
    const double max_points = splitter_.maximum_number_of_points();
    AssertThrow(n_points <= max_points,
                ExcUser(text("There are ",
                             n_points,
                             " points, more than 'Splitting/Maximum number of "
                             "points' = ",
                             max_points,
                             ". Allow more points, or use larger cells or "
                             "fewer points per cell.")));
  }



  template <int dim>
  std::string
  ExplicitScheme<dim>::description()
  {
    const double dt = stable_time_step();
    return text(std::setprecision(6),
                "t = ",
                state_.time,
                " s: the time step is ",
                dt,
                " s, limited by ",
                time_step_.limited_by(state_.points,
                                      state_.grid,
                                      problem_.materials,
                                      transfer_.box_shape()),
                ".");
  }



  template class ExplicitScheme<2>;
  template class ExplicitScheme<3>;
} // namespace talus

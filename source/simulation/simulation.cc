#include <talus/base/errors.h>
#include <talus/problem/geostatic.h>
#include <talus/simulation/simulation.h>
#include <talus/transfer/far_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Coverage and reach: the weights of every point sum to one. (Used in
    /// Debug only.)
    template <int dim>
    [[maybe_unused]] bool
    nobody_is_lost(const Points<dim>      &points,
                   const NodalFields<dim> &nodes,
                   const MPI_Comm          communicator)
    {
      const double *mass = points.data(points.mass);
      const double  of_points =
        Utilities::MPI::sum(std::accumulate(mass, mass + points.size(), 0.),
                            communicator);
      double of_nodes = 0;
      for (const unsigned int node : nodes.active_nodes())
        of_nodes += nodes.mass(node);
      of_nodes = Utilities::MPI::sum(of_nodes, communicator);
      return std::abs(of_nodes - of_points) <= 1e-12 * of_points;
    }
  } // namespace



  template <int dim>
  Simulation<dim>::Simulation(const Preview &preview)
    : ParameterAcceptor("/")
    , grid_(MPI_COMM_WORLD)
    , materials_(preview.materials)
    , loading_(preview.folder)
    , output_(timer_)
  {
    for (const std::string &name : preview.bodies)
      bodies_.push_back(std::make_unique<Body<dim>>(name));

    add_parameter("Title", title_, "One line about the case.");
    add_parameter("Dimension",
                  dimension_,
                  "2 (plane strain; all values are per metre width) or 3.",
                  this->prm,
                  Patterns::Integer(2, 3));
    add_parameter("End time",
                  end_time_,
                  "The simulation runs from time 0 to this time [s].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Initial velocity time",
      initial_velocity_time_,
      "Velocities live between the steps. 'start': take the initial "
      "velocity at t = 0; 'half step': at t = -dt/2, which keeps "
      "second order where the acceleration is not zero at the "
      "start.",
      this->prm,
      Patterns::Selection("start|half step"));
    enter_subsection("Bodies");
    add_parameter(
      "Names",
      names_of_bodies_,
      "Names of the bodies, separated by commas; each has a section "
      "of that name.");
    leave_subsection();
  }



  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    set_up_laws();
    create_mesh();
    create_bodies();
    share_out();
  }



  /// All that depends on the parameters only.
  template <int dim>
  void
  Simulation<dim>::set_up_laws()
  {
    constants_.values(); // throws, also where no expression needs them
    stages_.check();
    grid_.check();
    transfer_.check();
    output_.check(damping_.coefficient());
    std::vector<std::string> names, materials;
    for (const auto &body : bodies_)
      {
        names.push_back(body->name());
        materials.push_back(body->material());
      }
    materials_.assign(names, materials);
    trigger_.check(names, materials_, boundaries_.has_seabed(), end_time_);
    materials_.add_columns(points_,
                           trigger_.changes_strength() ||
                             stages_.contain(Stage::strength_reduction));
    trigger_.add_columns(points_);
    loading_.prepare(materials_, bodies_.size(), constants_);
    boundaries_.prepare(constants_);
    check_static_stages(names);

    const auto                  may_move = faces_that_may_move();
    std::array<double, 2 * dim> may_lie_outside;
    std::vector<bool>           cell_mean;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      may_lie_outside[face] = (may_move[face] ? 0. : 0.5);
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      cell_mean.push_back(materials_.of_body(b).uses_bbar());
    transfer_.use_cell_mean(cell_mean);
    relocation_.allow_outside(may_lie_outside);
  }



  template <int dim>
  void
  Simulation<dim>::create_bodies()
  {
    for (unsigned int b = 0; b < bodies_.size(); ++b)
      {
        const MaterialModel<dim> &material = materials_.of_body(b);
        const InitialState<dim>  &initial  = bodies_[b]->initial_state();
        const unsigned int        begin    = points_.size();
        initial.check(material);
        bodies_[b]->create_points(grid_, b, material.density(), points_);
        initial.set_velocity(points_, b, 0., constants_);
        initial.deform(points_,
                       begin,
                       points_.size(),
                       material,
                       transfer_.box_shape().rule,
                       constants_);
        material.initialize(points_, begin, points_.size());
      }
    start_notes_ =
      set_geostatic_stress(points_,
                           bodies_,
                           materials_,
                           loading_.share_of_gravity(0.) * loading_.gravity(),
                           grid_.communicator());
    for (const auto &body : bodies_)
      if (body->initial_state().is_displaced())
        {
          send_far_points(points_, grid_);
          break;
        }
    trigger_.choose_points(points_, constants_, grid_.communicator());
    number_points();
    relocation_.update(points_, grid_);
    nodes_.activate(grid_, relocation_.occupied_cells());

    if (initial_velocity_time_ == "half step")
      {
        const double dt = std::min(allowed_time_step(), end_time_ - time_);
        for (unsigned int b = 0; b < bodies_.size(); ++b)
          bodies_[b]->initial_state().set_velocity(points_,
                                                   b,
                                                   -0.5 * dt,
                                                   constants_);
      }
  }



  /// Ids are unique over all ranks, now and after splits.
  template <int dim>
  void
  Simulation<dim>::number_points()
  {
    const MPI_Comm     communicator = grid_.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const auto         counts =
      Utilities::MPI::all_gather(communicator, points_.size());
    double first = 0, n_points = 0;
    for (unsigned int r = 0; r < counts.size(); ++r)
      {
        first += (r < rank ? counts[r] : 0.);
        n_points += counts[r];
      }
    for (unsigned int p = 0; p < points_.size(); ++p)
      points_.data(points_.id)[p] = first + p;
    splitter_.number_from(n_points + rank, counts.size());
  }



  template <int dim>
  void
  Simulation<dim>::advance()
  {
    adapt_mesh();
    if (filter_.is_due(step_))
      {
        PhaseTimer::Scope scope(timer_, "filter");
        filter_.apply(
          points_, workspace_, grid_, nodes_, transfer_, least_mass_);
      }
    points_to_grid();
    choose_time_step();
    update_nodes();
    grid_to_points();
    split();
    relocate(); // daughters, too: they may live next door
    time_ += dt_;
    ++step_;
  }



  // The step goes over the points twice, here and in grid_to_points(), batch by
  // batch: what it needs of a point comes from memory once each time.
  template <int dim>
  void
  Simulation<dim>::points_to_grid()
  {
    timer_.start_laps();
    loading_.update(points_, time_);
    nodes_.clear();
    timer_.lap(PhaseTimer::points_to_grid);
    time_step_.begin();
    points_.for_batches([this](const Batch &batch) {
      workspace_.reinit(batch.begin, batch.end);
      time_step_.heed(points_, batch, grid_, materials_, transfer_.box_shape());
      timer_.lap(PhaseTimer::time_step);
      transfer_.average_mean_stress(points_, workspace_, batch);
      transfer_.scatter(
        points_, workspace_, batch, grid_, loading_.loads(), nodes_);
      timer_.lap(PhaseTimer::points_to_grid);
    });
  }



  template <int dim>
  void
  Simulation<dim>::choose_time_step()
  {
    // But for mesh tracking the only operation of all ranks in a step. The
    // largest wish is the one that becomes the least.
    PhaseTimer::Scope           scope(timer_, "messages");
    const std::array<double, 2> local = {
      {time_step_.of_heeded(points_, materials_),
       -static_cast<double>(own_wish())}};
    std::array<double, 2> all;
    Utilities::MPI::min(ArrayView<const double>(local.data(), 2),
                        grid_.communicator(),
                        ArrayView<double>(all.data(), 2));
    dt_   = std::min(all[0], end_time_ - time_);
    wish_ = static_cast<Wish>(-all[1]);
  }



  template <int dim>
  void
  Simulation<dim>::update_nodes()
  {
    {
      PhaseTimer::Scope scope(timer_, "messages");
      nodes_.sum_over_ranks(grid_);
    }
    Assert(nobody_is_lost(points_, nodes_, grid_.communicator()),
           ExcMessage("The nodes do not carry all mass of the points: a box "
                      "reaches beyond the cells around its own."));
    {
      PhaseTimer::Scope scope(timer_, "nodal update");
      boundaries_.add_tractions(nodes_, grid_, time_, least_mass_);
      nodes_.update_momentum(dt_, least_mass_);
      boundary_work_.damping +=
        damping_.apply(nodes_, grid_, boundaries_, least_mass_);
    }
    {
      PhaseTimer::Scope scope(timer_, "boundaries");
      boundaries_.scale_seabed_shear_stress(
        trigger_.seabed_factor(time_ + dt_));
      boundary_work_ +=
        boundaries_.apply(nodes_, grid_, time_, dt_, least_mass_);
    }
    PhaseTimer::Scope scope(timer_, "messages");
    nodes_.share_with_ghosts(grid_);
  }



  template <int dim>
  void
  Simulation<dim>::grid_to_points()
  {
    timer_.start_laps();
    trigger_.update(points_, materials_.strength_factor(), time_, time_ + dt_);
    const BoxRule rule = transfer_.box_shape().rule;
    points_.for_batches([&](const Batch &batch) {
      workspace_.reinit(batch.begin, batch.end);
      gravity_work_ += transfer_.gather(
        nodes_, grid_, loading_.loads(), points_, workspace_, batch, dt_);
      transfer_.average_dilatation(points_, workspace_, batch);
      timer_.lap(PhaseTimer::grid_to_points);
      materials_.update_stress(points_, workspace_, batch, dt_);
      update_stretch(points_, workspace_, batch.begin, batch.end, rule, dt_);
      timer_.lap(PhaseTimer::stress_update);
      splitter_.find(points_, batch, grid_, rule);
      timer_.lap(PhaseTimer::splitting);
    });
  }



  template <int dim>
  void
  Simulation<dim>::split()
  {
    PhaseTimer::Scope scope(timer_, "splitting");
    splitter_.enforce(points_,
                      transfer_.box_shape().rule,
                      workspace_.points_out_of_cell());
  }



  template <int dim>
  void
  Simulation<dim>::relocate()
  {
    PhaseTimer::Scope scope(timer_, "relocation");
    const bool        other_cells =
      relocation_.update_points_out_of_cell(points_,
                                            grid_,
                                            workspace_.points_out_of_cell());
    if (other_cells)
      nodes_.activate(grid_, relocation_.occupied_cells());
  }



  template <int dim>
  Snapshot<dim>
  Simulation<dim>::snapshot() const
  {
    return {points_,
            grid_,
            nodes_,
            boundary_work_,
            splitter_.statistics(),
            step_,
            time_,
            dt_,
            gravity_work_,
            transfer_.box_shape()};
  }



  template <int dim>
  bool
  Simulation<dim>::run()
  {
    begin_run();
    if (!run_static_stages())
      return false;
    output_.start(snapshot());
    while (!is_finished())
      {
        advance();
        if (output_.observe(snapshot(), time_ >= end_time_))
          note_time_step();
        if (act_on(wish_))
          return false;
      }
    return true;
  }



  template <int dim>
  std::string
  Simulation<dim>::write_last_state()
  {
    return output_.write_last_state(snapshot());
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/interrupt.h>
#include <talus/base/shell.h>
#include <talus/checkpoint/parameter_changes.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>
#include <talus/maps/map_observers.h>
#include <talus/observers/boundary_forces.h>
#include <talus/observers/facets_output.h>
#include <talus/observers/footprint.h>
#include <talus/observers/obstacle_forces.h>
#include <talus/observers/obstacles_output.h>
#include <talus/observers/state_cells.h>
#include <talus/problem/drainage.h>
#include <talus/simulation/pace.h>
#include <talus/simulation/run_remarks.h>
#include <talus/simulation/shear_bands.h>
#include <talus/simulation/simulation.h>
#include <talus/version.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Each member declares its own parameters; the parameters here belong to the
  /// run. Output does not know the splitter: a function adds the columns of the
  /// splitter.
  template <int dim>
  Simulation<dim>::Simulation(const ParameterPreview &preview,
                              const MPI_Comm          communicator)
    : ParameterAcceptor("/")
    , log_(communicator)
    , state_(communicator)
    , problem_(preview)
    , mesh_(state_, problem_, transfer_, timer_)
    , scheme_(state_, problem_, transfer_, mesh_, timer_)
    , output_(timer_, log_, &problem_.obstacles)
    , static_stages_(state_, problem_, transfer_, output_, log_)
  {
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
    add_parameter("End when at rest",
                  ends_at_rest_,
                  "Whether the run ends before the end time when the slide is "
                  "at rest; the section Rest defines rest.");
    add_observers();
  }



  template <int dim>
  void
  Simulation<dim>::add_observers()
  {
    output_.add_row_observer(
      std::make_unique<ObstacleForces<dim>>(problem_.contact));
    output_.add_row_observer(
      std::make_unique<BoundaryForces<dim>>(problem_.boundaries.reactions()));
    output_.add_row_observer(std::make_unique<ShearBands<dim>>(problem_));
    output_.add_field_observer(
      std::make_unique<ObstaclesOutput<dim>>(problem_.obstacles));
    output_.add_field_observer(
      std::make_unique<FacetsOutput<dim>>(problem_.contact));
    add_map_observers(problem_, output_);
    output_.add_point_field(
      scalar_field("mobilized strength", "", [this](const unsigned int p) {
        const Points<dim> &points = state_.points;
        return problem_.materials.of_body(points.data(points.body)[p])
          .mobilized_strength(points, p);
      }));
    // The remark on the contact area uses the numbers of the same row.
    const auto areas = std::make_shared<Quantities>();
    output_.add_quantities(
      [this, areas](const State<dim> &state, Quantities &list) {
        areas->clear();
        list_contact_area(state, problem_.boundaries, problem_.contact, *areas);
        list.insert(list.end(), areas->begin(), areas->end());
        scheme_.splitter().list_quantities(state, list);
        scheme_.merger().list_quantities(state, list);
        rest_.list_quantities(list);
        state.outflow.list_quantities(state.communicator(), list);
        scheme_.inflow().list_quantities(list);
        problem_.interactions.list_quantities(state, list);
      });
    auto remarks = std::make_unique<RunRemarks<dim>>(log_);
    remarks->add("split limit remark", [this](const State<dim> &state) {
      return remark_on_split_limits(state, scheme_.splitter());
    });
    remarks->add("speed remark", [this](const State<dim> &state) {
      return remark_on_speed(state, problem_.materials);
    });
    remarks->add("hydroplaning remark", [this](const State<dim> &state) {
      return problem_.hydroplaning.report(state);
    });
    remarks->add("contact area remark", [areas](const State<dim> &state) {
      return remark_on_contact_area(state.time, *areas);
    });
    output_.add_row_observer(std::move(remarks)); // after the statistics
  }



  /// The mesh comes before the points, which are made cell by cell. Then cells
  /// are distributed by their numbers of points.
  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    prepare();
    mesh_.create(log_);
    create_points();
    mesh_.repartition();
    // Errors of the first step stop the run here, where nothing is written yet.
    problem_.loading.update(state_.points, state_.time);
    problem_.boundaries.check_values(state_.grid, state_.time);
    if (static_stages_.stages().contain(Stage::dynamics))
      scheme_.check_effort(end_time_);
    output_.check_observers(state_);
  }



  /// Prepare everything that depends on the parameters only. Errors in the
  /// parameters are found here, before a mesh is made or a file touched. A
  /// resumed run passes here, too, so columns are the same.
  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    parameters_ = parameters_as_text(this->prm);
    static_stages_.check_list();
    state_.grid.check();
    output_.check(problem_.damping.coefficient());
    check_can_be_made(output_.folder());
    check_can_be_made(output_.folder() + "/checkpoints");
    problem_.prepare(state_.points,
                     static_stages_.stages().contain(Stage::strength_reduction),
                     end_time_,
                     state_.grid);
    static_stages_.check();
    transfer_.use_bbar(problem_.bodies_with_bbar());
    state_.constants.box_shape = transfer_.box_shape();
    if (transfer_.scheme().is_filtered())
      state_.constants.held_faces = problem_.boundaries.fixed_faces();
    state_.constants.added_mass = problem_.water.added_mass_of_bodies();
    state_.constants.gravity    = problem_.loading.gravity();
    scheme_.splitter().prepare(state_.constants.box_shape);
    scheme_.merger().prepare(scheme_.splitter(), state_.constants.box_shape);
    problem_.open_accounts(state_.accounts);
    scheme_.inflow().prepare();
    scheme_.merger().open_accounts(state_.accounts);
  }



  /// Make the points. Ids are unique over all ranks, now and after splits:
  /// points are numbered rank after rank. Children get later numbers, each rank
  /// every n-th number, so that splits need no message.
  template <int dim>
  void
  Simulation<dim>::create_points()
  {
    Points<dim> &points = state_.points;
    problem_.create_points(state_);
    scheme_.inflow().mark_feeding_points();

    const MPI_Comm     communicator = state_.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const auto counts = Utilities::MPI::all_gather(communicator, points.size());
    double     first = 0, n_points = 0;
    for (unsigned int r = 0; r < counts.size(); ++r)
      {
        first += (r < rank ? counts[r] : 0.);
        n_points += counts[r];
      }
    for (unsigned int p = 0; p < points.size(); ++p)
      points.data(points.id)[p] = first + p;
    scheme_.splitter().number_from(n_points + rank, counts.size());

    mesh_.insert_points();
    // The first time step is known only when the points are in their cells.
    if (problem_.bodies().have_velocity_of_half_step())
      problem_.set_velocity(points,
                            -0.5 * std::min(scheme_.stable_time_step(),
                                            end_time_ - state_.time));
  }



  /// Inverse of write_checkpoint(): loads mesh, points, and the numbers of
  /// list_state(). Parameters are compared before anything is loaded. On
  /// another number of ranks the run continues, but not bit-identically. Cells
  /// are then distributed again, since p4est has distributed them evenly. The
  /// needs of output are checked last, when the state tells the previous length
  /// of the files.
  template <int dim>
  void
  Simulation<dim>::resume()
  {
    prepare();
    const MPI_Comm communicator = state_.communicator();
    resumed_from_        = find_checkpoint(output_.folder(), dim, communicator);
    const Hdf5Image file = open_state(resumed_from_.path, communicator);
    check_parameter_changes(file.read_text("parameters"), parameters_);
    check_columns(file, state_.points);

    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int n_ranks_then = resumed_from_.head.n_ranks;
    mesh_.load((resumed_from_.path / mesh_file_name).string(), n_ranks_then);
    load_state(file, list_state(), communicator);
    scheme_.splitter().renumber_after_resume(
      Utilities::MPI::this_mpi_process(communicator), n_ranks, n_ranks_then);
    if (n_ranks != n_ranks_then)
      mesh_.repartition();
    AssertThrow(end_time_ >= state_.time,
                ExcUser(text("The end time is ",
                             end_time_,
                             " s, but the checkpoint '",
                             resumed_from_.path.string(),
                             "' is at t = ",
                             state_.time,
                             " s. Give a later 'End time'.")));
    // End time and limit may differ from the previous run.
    if (static_stages_.stages().contain(Stage::dynamics))
      scheme_.check_effort(end_time_);
    output_.check_observers(state_);
    output_.check_resumable(state_);
    static_stages_.check_resumable(output_.folder());
  }



  /// Signals are remembered only here: another caller of begin() and step() may
  /// have handlers of its own.
  template <int dim>
  bool
  Simulation<dim>::run()
  {
    remember_signals();
    if (!begin())
      return false;
    while (!is_finished())
      if (!step())
        return false;
    end();
    return true;
  }



  template <int dim>
  bool
  Simulation<dim>::begin()
  {
    begin_run();
    if (!run_static_stages())
      return false;
    output_.start(state_);
    return true;
  }



  /// The scheme knows nothing of output and checkpoints: both happen here,
  /// between the steps.
  template <int dim>
  bool
  Simulation<dim>::step()
  {
    const RunRequest request = scheme_.advance(end_time_, local_request());
    rest_.update(state_, problem_.time_of_last_change());
    if (output_.observe(state_, is_finished()))
      note_time_step(LogLevel::detail);
    return !handle_request(request);
  }



  template <int dim>
  void
  Simulation<dim>::stop()
  {
    note_stop("as the program that leads the run asked for",
              write_checkpoint());
  }



  template <int dim>
  void
  Simulation<dim>::end()
  {
    note_end();
    output_.check_complete(state_.communicator());
    const std::string remarks = log_.count_of_remarks();
    log_.say(remarks.empty() ? LogLevel::info : LogLevel::result,
             "A report of this run: talus-report " +
               for_shell(output_.folder()) +
               (remarks.empty() ? "" : " (" + remarks + ")"));
  }



  /// A checkpoint follows each stage: a stage may have taken hours and cannot
  /// be resumed in the middle. The ranks agree on a stop by the maximum of the
  /// requests, which are numbered by priority.
  template <int dim>
  bool
  Simulation<dim>::run_static_stages()
  {
    const Stages &stages = static_stages_.stages();
    while (stages.next_is_static())
      {
        {
          PhaseTimer::Scope scope(timer_, "static stages");
          static_stages_.run_next();
        }
        // Before the checkpoint: a resumed run must not write the first row
        // again.
        if (!stages.next_is_static())
          output_.start(state_);
        const auto request = static_cast<RunRequest>(
          Utilities::MPI::max(static_cast<unsigned int>(local_request()),
                              state_.communicator()));
        if (handle_request(std::max(request, RunRequest::checkpoint)))
          return false;
      }
    static_stages_.check_soil_stands();
    return true;
  }



  template <int dim>
  bool
  Simulation<dim>::is_finished() const
  {
    return !static_stages_.stages().next_is_static() &&
           state_.time >= end_of_run();
  }



  /// Log how the dynamics ended.
  template <int dim>
  void
  Simulation<dim>::note_end()
  {
    const std::string sentence = rest_.sentence(state_.time, end_time_);
    if (sentence.empty())
      return;
    if (rest_.is_at_rest())
      log_.say(LogLevel::result, sentence);
    else
      log_.remark(sentence);
  }



  /// Return the time at which the run ends, s. A run without dynamics ends at
  /// 0.
  template <int dim>
  double
  Simulation<dim>::end_of_run() const
  {
    if (!static_stages_.stages().contain(Stage::dynamics))
      return 0.;
    return ends_at_rest_ && rest_.is_at_rest()
             ? std::min(state_.time, end_time_)
             : end_time_;
  }



  /// Begin the run in one of three ways. A run already at its end does nothing
  /// and leaves the files unchanged. A resumed run continues the files, a new
  /// run starts files. Collective.
  template <int dim>
  void
  Simulation<dim>::begin_run()
  {
    const bool is_resumed = beginning() == Beginning::resumed;
    output_.lock_folder(state_.communicator());
    if (is_resumed && is_finished())
      {
        // The run may have been killed after the last step.
        checkpoint_.begin(output_.folder(),
                          state_.communicator(),
                          resumed_from_.path);
        log_.say(LogLevel::result,
                 text("The run in '",
                      output_.folder(),
                      "' has reached its end, t = ",
                      state_.time,
                      " s; there is nothing left to do."));
        return;
      }
    begin_files();
    if (is_resumed)
      note_resume();
    else
      note_start(LogLevel::info);
    // A run without dynamics ends at 0.
    const Stages &stages = static_stages_.stages();
    if (is_resumed && resumed_from_.head.end_time == 0 &&
        stages.contain(Stage::dynamics) && !stages.next_is_static())
      {
        static_stages_.continue_with_dynamics();
        output_.restart_energy_budget(state_);
      }
    // The checkpoint of a finished run must not look finished now.
    if (is_resumed && resumed_from_.head.time >= resumed_from_.head.end_time)
      write_checkpoint();
  }



  template <int dim>
  Beginning
  Simulation<dim>::beginning() const
  {
    return resumed_from_.path.empty() ? Beginning::fresh : Beginning::resumed;
  }



  template <int dim>
  void
  Simulation<dim>::check_output_folder() const
  {
    // A finished run leaves the folder unchanged.
    if (beginning() == Beginning::resumed && is_finished())
      {
        output_.check_complete(state_.communicator());
        return;
      }
    if (beginning() == Beginning::fresh)
      checkpoint_.check_nothing_is_lost(output_.folder(),
                                        state_.communicator());
    output_.check_folder(state_.communicator(), beginning());
  }



  /// Begin all files. Whether results would be lost is checked before the first
  /// file is opened. Checkpoints of an earlier run are removed last, when the
  /// new files exist.
  template <int dim>
  void
  Simulation<dim>::begin_files()
  {
    check_output_folder();
    output_.begin(state_, end_time_, parameters_, beginning());
    output_.keep_lock();
    static_stages_.begin(output_.folder(), beginning());
    checkpoint_.begin(output_.folder(),
                      state_.communicator(),
                      resumed_from_.path);
  }



  /// Log title, mesh, consequences of the parameters, remarks, and time step.
  template <int dim>
  void
  Simulation<dim>::note_start(const LogLevel level)
  {
    if (!title_.empty())
      log_.say(level, title_);
    log_.say(level, mesh_.description());
    for (const std::string &fact : problem_.facts())
      log_.say(level, fact);
    problem_.add_remarks(notes_on_drainage(problem_.materials,
                                           problem_.bodies().thickness(),
                                           end_of_run()));
    for (const Remark &remark : problem_.remarks(state_.grid.cell_size()))
      log_.remark(remark);
    note_time_step(level);
  }



  template <int dim>
  void
  Simulation<dim>::note_time_step(const LogLevel level)
  {
    log_.say(level, scheme_.description() + mesh_.history());
  }



  template <int dim>
  void
  Simulation<dim>::forecast()
  {
    if (beginning() == Beginning::resumed)
      note_resume();
    else
      note_start(LogLevel::result);
    if (const std::string sentence =
          sentence_on_thinnest(problem_.bodies().thickness());
        !sentence.empty())
      log_.say(LogLevel::result, sentence);
    if (!static_stages_.stages().contain(Stage::dynamics) ||
        state_.time >= end_time_)
      return;
    const double n_steps =
      (end_time_ - state_.time) / scheme_.stable_time_step();
    const double n_points =
      Utilities::MPI::sum(1. * state_.points.size(), state_.communicator());
    const Pace pace = measure_pace(
      [&]() {
        advance();
        return state_.time < end_time_;
      },
      state_.communicator());
    log_.say(LogLevel::result,
             estimate(pace, n_steps, n_points, state_.communicator()));
  }



  /// Log skipped damaged checkpoints, missing results, the time of the
  /// checkpoint, and whether another version of the program wrote the
  /// checkpoint: results may then differ.
  template <int dim>
  void
  Simulation<dim>::note_resume()
  {
    const CheckpointHead &head = resumed_from_.head;
    for (const std::string &error : resumed_from_.errors)
      log_.remark(error + " The run continues from the previous checkpoint.");
    if (const std::string missing =
          output_.missing_files(state_.communicator());
        !missing.empty())
      log_.remark(
        text("The folder '",
             output_.folder(),
             "' lacks ",
             missing,
             ", written by the run and since then removed or cut short. The "
             "run continues, and ends with an error unless the missing files "
             "are restored."));
    std::string sentence = text("Resumed at t = ",
                                state_.time,
                                " s, step ",
                                state_.step,
                                ", from '",
                                resumed_from_.path.string(),
                                "'.");
    if (head.version != TALUS_VERSION || head.revision != TALUS_GIT_REVISION)
      sentence += text(" The checkpoint was written by talus ",
                       head.version,
                       ", revision '",
                       head.revision,
                       "', which is not the present program.");
    log_.say(LogLevel::info, sentence);
    note_time_step(state_.step == 0 ? LogLevel::info : LogLevel::detail);
  }



  /// List all state besides points, mesh and parameters. Derived data are
  /// computed anew; nodes hold nothing between the steps. The order of the list
  /// does not matter, because numbers are found by name.
  template <int dim>
  StateList
  Simulation<dim>::list_state()
  {
    StateList list;
    log_.list_state(list);
    state_.list_state(list);
    problem_.list_state(list);
    mesh_.list_state(list);
    scheme_.splitter().list_state(list);
    scheme_.merger().list_state(list);
    scheme_.inflow().list_state(list);
    static_stages_.list_state(list);
    rest_.list_state(list);
    output_.list_state(list);
    return list;
  }



  /// Return the request of this rank for the time after the present step. Only
  /// some ranks may get a signal, and only the first rank reads the clock:
  /// ranks may differ here, and agree in the step.
  template <int dim>
  RunRequest
  Simulation<dim>::local_request() const
  {
    if (!remembered_signal().empty() || checkpoint_.limit_is_reached())
      return RunRequest::stop;
    return checkpoint_.is_due(state_.step + 1) ? RunRequest::checkpoint
                                               : RunRequest::none;
  }



  /// Do what the ranks agreed on. Return whether the run stops here. At the end
  /// of a run a parameter, not the request, decides about a checkpoint.
  template <int dim>
  bool
  Simulation<dim>::handle_request(const RunRequest request)
  {
    const bool is_end    = is_finished();
    const bool is_wanted = (is_end ? checkpoint_.is_wanted_at_the_end()
                                   : request != RunRequest::none);
    if (!is_wanted)
      return false;
    const std::filesystem::path path = write_checkpoint();
    if (is_end || request != RunRequest::stop)
      return false;

    const std::string signal = remembered_signal();
    note_stop(!signal.empty()                  ? "after the signal " + signal
              : checkpoint_.limit_is_reached() ? "after the limit of wall time"
                                               : "after a signal to another "
                                                 "rank",
              path);
    return true;
  }



  /// Log why the run stops, and how to continue from the checkpoint @p path.
  template <int dim>
  void
  Simulation<dim>::note_stop(const std::string           &reason,
                             const std::filesystem::path &path)
  {
    const std::string remarks = log_.count_of_remarks();
    log_.say(LogLevel::result,
             text("Stopped at t = ",
                  state_.time,
                  " s, step ",
                  state_.step,
                  ", ",
                  reason,
                  "; the state is in '",
                  path.string(),
                  "'. Continue with the same command and --resume.",
                  remarks.empty() ? "" : " (" + remarks + ")"));
  }



  /// Write a checkpoint after all output is on the disk: if the machine lost
  /// rows and fields, the run could not be resumed from the checkpoint.
  /// Collective.
  template <int dim>
  std::filesystem::path
  Simulation<dim>::write_checkpoint()
  {
    PhaseTimer::Scope scope(timer_, "checkpoint");
    output_.sync(state_.communicator());
    const std::vector<double> cell_weights = mesh_.cell_weights();
    const StateList           list         = list_state();
    return checkpoint_.write({state_.grid,
                              state_.points,
                              cell_weights,
                              list,
                              parameters_,
                              state_.step,
                              state_.time,
                              end_of_run()});
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/interrupt.h>
#include <talus/checkpoint/parameter_changes.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>
#include <talus/maps/map_observers.h>
#include <talus/observers/boundary_forces.h>
#include <talus/observers/facets_output.h>
#include <talus/observers/footprint.h>
#include <talus/observers/obstacle_forces.h>
#include <talus/observers/obstacles_output.h>
#include <talus/simulation/pace.h>
#include <talus/simulation/simulation.h>
#include <talus/simulation/split_limit_remark.h>
#include <talus/version.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Each member declares its own parameters; those here are the run's. Output
  /// does not know the splitter, so its columns are added by a function.
  template <int dim>
  Simulation<dim>::Simulation(const ParameterPreview &preview)
    : ParameterAcceptor("/")
    , state_(MPI_COMM_WORLD)
    , problem_(preview)
    , mesh_(state_, problem_, transfer_, timer_)
    , scheme_(state_, problem_, transfer_, mesh_, timer_)
    , output_(timer_, log_, &problem_.obstacles)
    , static_stages_(state_, problem_, transfer_, mesh_, output_, log_)
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
                  "Whether a slide that has come to rest ends the run before "
                  "the end time; the section Rest says what rest is.");
    output_.add_row_observer(
      std::make_unique<ObstacleForces<dim>>(problem_.contact));
    output_.add_row_observer(
      std::make_unique<BoundaryForces<dim>>(problem_.boundaries.reactions()));
    output_.add_row_observer(
      std::make_unique<SplitLimitRemark<dim>>(scheme_.splitter(), log_));
    output_.add_field_observer(
      std::make_unique<ObstaclesOutput<dim>>(problem_.obstacles));
    output_.add_field_observer(
      std::make_unique<FacetsOutput<dim>>(problem_.contact));
    add_map_observers(problem_, output_);
    output_.add_quantities([this](const State<dim> &state, Quantities &list) {
      list_contact_area(state, problem_.boundaries, problem_.contact, list);
      note_contact_area(list);
      scheme_.splitter().list_quantities(state, list);
      scheme_.merger().list_quantities(state, list);
      rest_.list_quantities(list);
      state.outflow.list_quantities(state.communicator(), list);
      problem_.water.list_quantities(state,
                                     -problem_.loading.gravity()[1],
                                     list);
    });
  }



  /// Tell once that soil does not touch the ground that lies under it. @p list
  /// ends with contact area and footprint; a contact area of 0 is that of a
  /// run before its first step.
  template <int dim>
  void
  Simulation<dim>::note_contact_area(const Quantities &list)
  {
    const Quantity &footprint = list.back(), &area = list[list.size() - 2];
    const double    ratio = area.value / footprint.value;
    if (has_noted_contact_area_ || area.value == 0 || footprint.value == 0 ||
        (ratio >= 0.95 && ratio <= 1.05))
      return;
    has_noted_contact_area_ = true;
    log_.remark(
      text(std::setprecision(4),
           "At t = ",
           state_.time,
           " s soil touches ",
           area.value,
           ' ',
           area.unit,
           " of the ",
           footprint.value,
           ' ',
           footprint.unit,
           " of ground under it, a ratio of ",
           ratio,
           " where 0.95 to 1.05 was expected. Soil is in the air there, "
           "or friction acts on a wrong area: look at the fields, and "
           "compare with smaller cells."));
  }



  /// The mesh before the points, which are made cell by cell; then cells are
  /// shared out by the points that they have. Collective.
  template <int dim>
  void
  Simulation<dim>::set_up()
  {
    prepare();
    mesh_.create(log_);
    create_points();
    mesh_.repartition();
    // What would stop the first step stops here, where nothing is written yet.
    problem_.loading.update(state_.points, state_.time);
    problem_.boundaries.check_values(state_.grid, state_.time);
    check_number_of_steps();
    check_number_of_points();
    output_.check_observers(state_);
  }



  /// A run that cannot end in months is a mistake in some unit, and would write
  /// one row in all that time. Collective.
  template <int dim>
  void
  Simulation<dim>::check_number_of_steps()
  {
    if (!static_stages_.stages().contain(Stage::dynamics))
      return;
    const double dt      = scheme_.stable_time_step();
    const double n_steps = (end_time_ - state_.time) / dt;
    AssertThrow(n_steps <= 1e12,
                ExcUser(text(std::setprecision(6),
                             "The run would take ",
                             n_steps,
                             " time steps of ",
                             dt,
                             " s to 'End time' = ",
                             end_time_,
                             " s, which cannot end. Check the units of "
                             "stiffness, density, cell size, velocities and "
                             "'End time', and 'Time step/Maximum'.")));
  }



  /// The splitter would say so in the first step, when the results of an earlier
  /// run are gone. Collective.
  template <int dim>
  void
  Simulation<dim>::check_number_of_points() const
  {
    const double n_points =
      Utilities::MPI::sum(1. * state_.points.size(), state_.communicator());
    const double most = scheme_.splitter().maximum_number_of_points();
    AssertThrow(!static_stages_.stages().contain(Stage::dynamics) ||
                  n_points <= most,
                ExcUser(text("There are ",
                             n_points,
                             " points, more than 'Splitting/Maximum number of "
                             "points' = ",
                             most,
                             ". Allow more points, or make fewer: by larger "
                             "cells or fewer points per cell.")));
  }



  /// All that depends on the parameters only.
  /// What can be wrong with the parameters by themselves is found here, before
  /// a mesh is made or a file touched. A resumed run comes through here, too,
  /// so columns are the same.
  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    static_stages_.check_list();
    state_.grid.check();
    transfer_.check();
    output_.check(scheme_.damping().coefficient());
    check_can_be_made(output_.folder());
    check_can_be_made(output_.folder() + "/checkpoints");
    problem_.prepare(state_.points,
                     static_stages_.stages().contain(Stage::strength_reduction),
                     end_time_,
                     state_.grid.origin());
    problem_.contact.set_averaging_time(output_.force_averaging_time());
    problem_.boundaries.reactions().set_averaging_time(
      output_.force_averaging_time());
    static_stages_.check();
    transfer_.use_bbar(problem_.bodies_with_bbar());
    state_.box_shape = transfer_.box_shape();
    scheme_.merger().check(scheme_.splitter());
    state_.may_merge = scheme_.merger().is_enabled();
  }



  /// Ids are unique over all ranks, now and after splits.
  /// Rank after rank as the points are; children get numbers from beyond, each
  /// rank every n-th one, so that no message is needed when points split.
  template <int dim>
  void
  Simulation<dim>::create_points()
  {
    Points<dim> &points = state_.points;
    problem_.create_points(state_);

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
    // The first time step is known only now, with the points in their cells.
    if (problem_.has_velocity_of_half_step())
      problem_.set_velocity(points,
                            -0.5 * std::min(scheme_.stable_time_step(),
                                            end_time_ - state_.time));
  }



  /// The mirror image of write_checkpoint(): mesh, then points, then the
  /// numbers of list_state(). Parameters are compared before anything is
  /// loaded. On another number of ranks the run goes on, but not bitwise; cells
  /// are then shared out anew, as p4est has shared them evenly. What output
  /// needs is checked last, when the state says how long the files were.
  /// Collective.
  template <int dim>
  void
  Simulation<dim>::resume()
  {
    prepare();
    const MPI_Comm communicator = state_.communicator();
    resumed_from_ = find_checkpoint(output_.folder(), dim, communicator);
    Hdf5InputFile     file(resumed_from_.path / state_file_name, communicator);
    const std::string parameters = file.read_text("parameters");
    check_read(file);
    check_parameter_changes(parameters, parameters_as_text(this->prm));

    mesh_.load((resumed_from_.path / mesh_file_name).string(),
               file,
               resumed_from_.head);
    load_state(file, list_state());
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int n_ranks_then = resumed_from_.head.n_ranks;
    scheme_.splitter().number_on(Utilities::MPI::this_mpi_process(communicator),
                                 n_ranks,
                                 n_ranks_then);
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
    // The end and the limit may be others than those of the run before.
    check_number_of_steps();
    check_number_of_points();
    output_.check_observers(state_);
    output_.check_resumable(state_);
    static_stages_.check_resumable(output_.folder());
  }



  /// Returns false if the run was stopped and can be resumed. Steps know
  /// nothing of output and checkpoints: all that happens between them is here.
  template <int dim>
  bool
  Simulation<dim>::run()
  {
    begin_run();
    if (!run_static_stages())
      return false;
    output_.start(state_);
    while (!is_finished())
      {
        const RunRequest request = scheme_.advance(end_time_, local_request());
        rest_.update(state_, problem_.time_of_last_change());
        if (output_.observe(state_, is_finished()))
          note_time_step(LogLevel::detail);
        if (handle_request(request))
          return false;
      }
    note_end();
    output_.check_complete(state_.communicator());
    const std::string remarks = log_.count_of_remarks();
    log_.say(remarks.empty() ? LogLevel::info : LogLevel::result,
             "A report of this run: talus-report " + output_.folder() +
               (remarks.empty() ? "" : " (" + remarks + ")"));
    return true;
  }



  /// After each stage a checkpoint, as a stage may have taken hours and cannot
  /// be resumed in the middle. Ranks agree on whether to stop by a maximum,
  /// since the requests are numbered by how much they ask for.
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
        // Before the checkpoint, so that a resumed run does not write the first
        // row again.
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



  /// To the log, how the dynamics ended.
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



  /// A run without dynamics ends where it begins, s.
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



  /// Three kinds of beginning: a run that is already at its end does nothing,
  /// and leaves its files as they are; a resumed one goes on with its files; a
  /// new one starts them. Collective.
  template <int dim>
  void
  Simulation<dim>::begin_run()
  {
    const bool is_resumed = beginning() == Beginning::resumed;
    output_.lock_folder(state_.communicator());
    if (is_resumed && is_finished())
      {
        // It may have been killed after its last step.
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
    remember_signals();
    if (is_resumed)
      note_resume();
    else
      note_start(LogLevel::info);
    // The checkpoint of a run that was finished must not look finished now.
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
    // Which is left as it is.
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



  /// The question whether results would be lost comes before the first file is
  /// opened. Checkpoints of an earlier run go last, when the new files are
  /// there.
  template <int dim>
  void
  Simulation<dim>::begin_files()
  {
    check_output_folder();
    output_.begin(state_, end_time_, beginning());
    static_stages_.begin(output_.folder(), beginning());
    checkpoint_.begin(output_.folder(),
                      state_.communicator(),
                      resumed_from_.path);
  }



  /// Title, mesh, what follows from the parameters, remarks, time step.
  template <int dim>
  void
  Simulation<dim>::note_start(const LogLevel level)
  {
    if (!title_.empty())
      log_.say(level, title_);
    log_.say(level, mesh_.description());
    for (const std::string &fact : problem_.facts())
      log_.say(level, fact);
    for (const std::string &remark : problem_.remarks(state_.grid.cell_size()))
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
    const std::vector<BodyThickness> &bodies = problem_.thickness_of_bodies();
    if (const auto thinnest =
          std::min_element(bodies.begin(),
                           bodies.end(),
                           [](const auto &a, const auto &b) {
                             return a.n_cells < b.n_cells;
                           });
        thinnest != bodies.end())
      log_.say(LogLevel::result,
               text(std::setprecision(3),
                    "The thinnest body, '",
                    thinnest->body,
                    "', is ",
                    thinnest->n_cells,
                    " cells of ",
                    thinnest->cell_size,
                    " m thick where it is thickest."));
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



  /// Which checkpoints were passed over since they are damaged, where the run
  /// goes on, which results are missing, and whether another program wrote it:
  /// then the result may differ.
  template <int dim>
  void
  Simulation<dim>::note_resume()
  {
    const CheckpointHead &head = resumed_from_.head;
    for (const std::string &error : resumed_from_.errors)
      log_.remark(error + " The run goes on from the one before.");
    if (const std::string missing =
          output_.missing_files(state_.communicator());
        !missing.empty())
      log_.remark(
        text("The folder '",
             output_.folder(),
             "' lacks ",
             missing,
             ", which the run wrote before and somebody has removed or "
             "cut short. The run goes on, and ends with an error unless what "
             "is missing "
             "is put back."));
    std::string sentence = text("Resumed at t = ",
                                state_.time,
                                " s, step ",
                                state_.step,
                                ", from '",
                                resumed_from_.path.string(),
                                "'.");
    if (head.version != TALUS_VERSION || head.revision != TALUS_GIT_REVISION)
      sentence += text(" That was written by talus ",
                       head.version,
                       ", revision '",
                       head.revision,
                       "', another one than this.");
    log_.say(LogLevel::info, sentence);
    note_time_step(state_.step == 0 ? LogLevel::info : LogLevel::detail);
  }



  /// All state besides points, mesh and parameters. What follows from these is
  /// computed anew; nodes hold nothing between the steps.
  /// The order does not matter, the names do: numbers are found by them.
  template <int dim>
  StateList
  Simulation<dim>::list_state()
  {
    StateList list;
    log_.list_state(list);
    list.add("contact area remark",
             "-",
             has_noted_contact_area_,
             Reduction::equal);
    state_.list_state(list);
    problem_.list_state(list);
    mesh_.list_state(list);
    scheme_.splitter().list_state(list);
    scheme_.merger().list_state(list);
    static_stages_.list_state(list);
    rest_.list_state(list);
    output_.list_state(list);
    return list;
  }



  /// What this rank wants to happen after the step that begins.
  /// By signals, which only some ranks may get, and by the clock of the first
  /// rank: ranks may differ here, and agree in the step.
  template <int dim>
  RunRequest
  Simulation<dim>::local_request() const
  {
    if (!remembered_signal().empty() || checkpoint_.limit_is_reached())
      return RunRequest::stop;
    return checkpoint_.is_due(state_.step + 1) ? RunRequest::checkpoint
                                               : RunRequest::none;
  }



  /// Do what the ranks agreed on. Returns whether the run is to stop here.
  /// Of a run at its end the parameter decides whether it gets a checkpoint,
  /// not what was asked for.
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
    log_.say(LogLevel::result,
             text("Stopped at t = ",
                  state_.time,
                  " s, step ",
                  state_.step,
                  !signal.empty() ? ", after the signal " + signal
                  : checkpoint_.limit_is_reached()
                    ? ", after the limit of wall time"
                    : ", after a signal to another rank",
                  "; the state is in '",
                  path.string(),
                  "'. Go on with the same command and --resume.",
                  log_.count_of_remarks().empty()
                    ? ""
                    : " (" + log_.count_of_remarks() + ")"));
    return true;
  }



  /// Output goes to the disk first: a checkpoint whose rows and fields were
  /// lost with the machine could not be resumed from. Collective.
  template <int dim>
  std::filesystem::path
  Simulation<dim>::write_checkpoint()
  {
    PhaseTimer::Scope scope(timer_, "checkpoint");
    output_.sync();
    const std::vector<double> cell_weights = mesh_.cell_weights();
    const StateList           list         = list_state();
    const std::string         parameters   = parameters_as_text(this->prm);
    return checkpoint_.write({state_.points,
                              cell_weights,
                              list,
                              parameters,
                              state_.step,
                              state_.time,
                              end_of_run()},
                             state_.grid);
  }



  template class Simulation<2>;
  template class Simulation<3>;
} // namespace talus

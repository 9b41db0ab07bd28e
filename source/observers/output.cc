// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>
#include <talus/io/text_file.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/output.h>
#include <talus/observers/phase_times.h>
#include <talus/observers/profile.h>
#include <talus/observers/progress.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Declare the entries of section Output for field files.
    void
    add_field_parameters(ParameterAcceptor &section, OutputSettings &settings)
    {
      section.add_parameter(
        "Write points",
        settings.write_points,
        "Write the points with all their columns for ParaView.");
      section.add_parameter(
        "Write grid",
        settings.write_grid,
        "Write the cells of the background grid that hold points, "
        "with nodal mass, velocity and force, for ParaView.");
      section.add_parameter(
        "Write obstacles",
        settings.write_obstacles,
        "If there are obstacles, write the surfaces of all obstacles, and the "
        "facets in contact with soil with the traction, for ParaView.");
      section.add_parameter(
        "Boxes as cells",
        settings.boxes_as_cells,
        "Write each point as a box, a quad or hex, instead of a dot: ParaView "
        "shows a continuum.");
    }
  } // namespace



  template <int dim>
  Output<dim>::Output(PhaseTimer           &timer,
                      Log                  &log,
                      const Obstacles<dim> *obstacles)
    : ParameterAcceptor("/Output")
    , timer_(timer)
    , log_(log)
  {
    add_parameter("Folder",
                  folder_,
                  "Folder for all files of the run, created if missing; files "
                  "of an earlier run are overwritten.");
    add_parameter("Statistics interval",
                  rows_.interval,
                  "Simulated time between two rows of statistics.csv, and "
                  "between two lines on the terminal [s]. Rows are written at "
                  "the first step that reaches a multiple of the interval.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Field interval",
                  fields_.interval,
                  "Simulated time between two outputs of points, grid and "
                  "profile [s]. Fields are written at the first step that "
                  "reaches a multiple of the interval.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter(
      "Plan interval",
      settings_.plan_interval,
      "Simulated time between two states in the series plan.csv, "
      "the soil in each cell of the maps: talus-tsunami makes the "
      "source of a tsunami model from the series [s]. 0: no series.",
      this->prm,
      Patterns::Double(0.));
    add_field_parameters(*this, settings_);
    add_parameter("Runout",
                  settings_.write_runout,
                  "Write the runout: the columns of front and rear in "
                  "statistics.csv, and profile.csv. Not allowed with local "
                  "damping, which falsifies the runout.");
    add_parameter("Force averaging time",
                  settings_.averaging_time,
                  "Time constant of the running mean of the forces on "
                  "obstacles and mesh faces, for the columns of the least and "
                  "largest mean force [s]: extremes of single steps are "
                  "impacts too short to load a structure. 0: no averaging.",
                  this->prm,
                  Patterns::Double(0.));
    list_observers(obstacles);
  }



  /// A new observer is added here in one line, to rows_ (called when a row is
  /// due) or to fields_ (called when fields are due).
  template <int dim>
  void
  Output<dim>::list_observers(const Obstacles<dim> *obstacles)
  {
    auto statistics = std::make_unique<Statistics<dim>>(obstacles);
    statistics_     = statistics.get();
    rows_.observers.push_back(std::move(statistics));
    fields_.observers.push_back(std::make_unique<Profile<dim>>(obstacles));
    auto points = std::make_unique<PointsOutput<dim>>();
    points_     = points.get();
    fields_.observers.push_back(std::move(points));
    fields_.observers.push_back(std::make_unique<GridOutput<dim>>());
  }



  template <int dim>
  void
  Output<dim>::set_folder(const std::string &folder)
  {
    // Set the parameter, so that parameters.prm contains the folder.
    this->enter_my_subsection(this->prm);
    this->prm.set("Folder", folder);
    this->leave_my_subsection(this->prm);
    folder_ = folder;
  }



  template <int dim>
  void
  Output<dim>::check(const double local_damping) const
  {
    AssertThrow(!folder_.empty(),
                ExcUser("Output/Folder is empty, but the name of a folder is "
                        "expected. Set Output/Folder or --output."));
    AssertThrow(std::none_of(folder_.begin(),
                             folder_.end(),
                             [](const unsigned char c) {
                               return c < ' ' || c == 127 || c == '#' ||
                                      c == '{';
                             }) &&
                  folder_.back() != '\\',
                ExcUser("The output folder '" + folder_ +
                        "' has a name with a control character (such as a line "
                        "break), a '#', a '{' or a '\\' at the end, which "
                        "parameters.prm cannot hold. Choose another name with "
                        "Output/Folder or --output."));
    check_utf8("The name of the output folder", folder_);
    AssertThrow(local_damping == 0 || !settings_.write_runout,
                ExcUser(text("'Damping/Local damping' is ",
                             local_damping,
                             ", but artificial damping falsifies the runout, "
                             "and Output/Runout is true. Set Output/Runout = "
                             "false or Damping/Local damping = 0.")));
  }



  template <int dim>
  void
  Output<dim>::check_observers(const State<dim> &state) const
  {
    for (const Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings_))
          {
            observer->check(state);
            if (const std::string name = observer->subfolder(); !name.empty())
              check_can_be_made(folder_ + "/" + name);
          }
  }



  template <int dim>
  void
  Output<dim>::check_folder(const MPI_Comm  communicator,
                            const Beginning beginning) const
  {
    const std::string sentence =
      first_sentence(is_first_rank(communicator)
                       ? foreign_file(folder_, beginning)
                       : "",
                     communicator);
    AssertThrow(sentence.empty(), ExcUser(sentence));
  }



  /// The first rank creates the folder before any rank opens a file in it,
  /// hence the barrier. parameters.prm is written first: write_file() replaces
  /// a file only on success, so an unwritable folder stops the run before
  /// earlier results are touched. Collective.
  template <int dim>
  void
  Output<dim>::begin(const State<dim>  &state,
                     const double       end_time,
                     const std::string &parameters,
                     const Beginning    beginning)
  {
    const MPI_Comm communicator = state.grid.communicator();
    if (is_first_rank(communicator))
      {
        make_folder(folder_);
        const std::filesystem::path record =
          std::filesystem::path(folder_) / "parameters.prm";
        const bool had_a_run = is_run_record(record);
        // The first write tests whether the folder is writable, and replaces an
        // earlier file only on success.
        write_run_record(record, parameters);
        if (beginning == Beginning::resumed || had_a_run)
          remove_results(folder_, beginning);
      }
    log_.open(folder_, beginning);
    MPI_Barrier(communicator);

    progress_.begin(state.time, end_time, communicator);
    settings_.folder = folder_;
    plan_.interval   = settings_.plan_interval;
    for (Schedule *schedule : {&rows_, &fields_, &plan_})
      {
        // Start from the time of the state, loaded from the checkpoint in a
        // resumed run: output continues at the same multiples of the interval
        // as without interruption.
        schedule->times.begin(schedule->interval, state.time);
        for (const auto &observer : schedule->observers)
          if (observer->is_enabled(settings_))
            observer->begin(settings_, state, beginning);
      }
  }



  /// The first row and fields belong to the beginning of the motion, after the
  /// static stages. has_started_ is part of the checkpoint, so a resumed run
  /// does not write them again.
  template <int dim>
  void
  Output<dim>::start(const State<dim> &state)
  {
    state.grid.sent() = {}; // without static stages
    if (has_started_)
      return;
    has_started_ = true;
    for (Schedule *schedule : {&rows_, &fields_, &plan_})
      {
        for (const auto &observer : schedule->observers)
          if (observer->is_enabled(settings_))
            observer->start(state);
        write(*schedule, state);
      }
  }



  /// The two schedules are queried before any output, because reached()
  /// returns true only once. Output times depend only on the simulated time, so
  /// all ranks agree without a message.
  template <int dim>
  bool
  Output<dim>::observe(const State<dim> &state, const bool last)
  {
    progress_.count_step(state.points.size());
    follow(state);
    const bool rows_are_due   = rows_.is_due(state, last);
    const bool fields_are_due = fields_.is_due(state, last);
    if (rows_are_due)
      {
        write(rows_, state);
        progress_.print_line(state.time, state.points.size());
      }
    if (fields_are_due)
      write(fields_, state);
    if (plan_.is_due(state, last))
      write(plan_, state);
    if (last)
      {
        // Wall times are written to the log only: files compared between runs
        // contain no wall times.
        for (const std::string &line :
             phase_times(timer_, state.communicator()))
          log_.say(LogLevel::info, line);
        for (const std::string &line : work_of_ranks(
               timer_, progress_, state.grid.sent(), state.communicator()))
          log_.say(LogLevel::info, line);
        progress_.finish(state.time, state.points.size());
      }
    return fields_are_due;
  }



  /// The time is added to the phase "output".
  template <int dim>
  void
  Output<dim>::follow(const State<dim> &state)
  {
    const PhaseTimer::Scope scope(timer_, "output");
    for (const Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings_))
          observer->follow(state);
  }



  /// In the last step everything is due, except output already written in the
  /// same step: a repeated row would contain means over an interval of zero
  /// length.
  template <int dim>
  bool
  Output<dim>::Schedule::is_due(const State<dim> &state, const bool last)
  {
    return times.reached(state.time) || (last && last_step != state.step);
  }



  /// The time is added to the phase "output".
  template <int dim>
  void
  Output<dim>::write(Schedule &schedule, const State<dim> &state)
  {
    const PhaseTimer::Scope scope(timer_, "output");
    for (const auto &observer : schedule.observers)
      if (observer->is_enabled(settings_))
        observer->observe(state);
    schedule.last_step = state.step;
  }



  /// Disabled observers list their state, too: the content of a checkpoint must
  /// not depend on parameters that may change when a run is resumed.
  template <int dim>
  void
  Output<dim>::list_state(StateList &list)
  {
    list.add("output has started", "-", has_started_, Reduction::equal);
    list.add("step of the last row", "-", rows_.last_step, Reduction::equal);
    list.add("step of the last fields",
             "-",
             fields_.last_step,
             Reduction::equal);
    list.add("step of the last plan", "-", plan_.last_step, Reduction::equal);
    for (Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        observer->list_state(list);
  }



  /// Call before any file is opened: begin() truncates files to the length at
  /// the checkpoint, which must not happen to a file while another file is
  /// missing. The first rank checks the files and sends the result to all
  /// ranks, so that all ranks throw.
  template <int dim>
  void
  Output<dim>::check_resumable(const State<dim> &state) const
  {
    OutputSettings settings = settings_;
    settings.folder         = folder_;
    for (const Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings))
          {
            const std::string sentence =
              first_sentence(observer->cannot_resume(settings, state),
                             state.communicator());
            AssertThrow(sentence.empty(), ExcUser(sentence));
          }
  }



  template <int dim>
  std::string
  Output<dim>::missing_files(const MPI_Comm communicator) const
  {
    if (!is_first_rank(communicator))
      return "";
    OutputSettings settings = settings_;
    settings.folder         = folder_;
    std::vector<std::string> missing;
    for (const char *name : {"parameters.prm", "log.txt", "lock"})
      if (!std::filesystem::exists(settings.folder / name))
        missing.push_back(name);
    for (const Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings))
          for (const std::string &name : observer->missing_files(settings))
            missing.push_back(name);
    if (missing.empty())
      return "";
    return text("'",
                missing.front(),
                "'",
                missing.size() > 1 ? text(" with ", missing.size() - 1, " more")
                                   : "");
  }



  /// Checked only at the end: a user may delete files during a run to free disk
  /// space for later output.
  template <int dim>
  void
  Output<dim>::check_complete(const MPI_Comm communicator) const
  {
    const std::string missing = missing_files(communicator);
    const std::string sentence =
      missing.empty()
        ? ""
        : text("The run is at its end, but '",
               folder_,
               "' lacks ",
               missing,
               ", written by the run and since then removed or cut short. All "
               "other files are complete. Restore the missing files, or start "
               "anew with --overwrite.");
    const std::string first = first_sentence(sentence, communicator);
    AssertThrow(first.empty(), ExcUser(first));
  }



  template <int dim>
  void
  Output<dim>::sync(const MPI_Comm communicator)
  {
    for (const Schedule *schedule : {&rows_, &fields_, &plan_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings_))
          observer->sync();
    // Force the names of the field files, listed in a checkpoint, to disk, too.
    if (is_first_rank(communicator))
      sync_to_disk(folder_);
  }



  /// Uses a separate series, restarted at each call: only the last of several
  /// failures is kept.
  template <int dim>
  void
  Output<dim>::write_mechanism(const State<dim>          &state,
                               const std::string         &name,
                               const std::vector<double> &mechanism) const
  {
    PointsOutput<dim> output(name);
    output.begin(settings_, state);
    output.write(state,
                 {{"mechanism",
                   "-",
                   FieldKind::vector,
                   [&](const unsigned int p, double *values) {
                     for (unsigned int d = 0; d < dim; ++d)
                       values[d] = mechanism[dim * p + d];
                   }}});
  }



  /// Not collective: an error may have stopped a single rank, and waiting for
  /// the other ranks would never end. Each rank writes a separate VTU file.
  template <int dim>
  std::string
  Output<dim>::write_last_state(const State<dim> &state) const
  {
    const MPI_Comm    communicator = state.communicator();
    const std::string rank =
      (Utilities::MPI::n_mpi_processes(communicator) == 1
         ? ""
         : "." +
             std::to_string(Utilities::MPI::this_mpi_process(communicator)));
    const std::filesystem::path path =
      std::filesystem::path(folder_) / ("last-state" + rank + ".vtu");
    make_folder(folder_);
    write_points(state, path);
    return path.string();
  }



  template class Output<2>;
  template class Output<3>;
} // namespace talus

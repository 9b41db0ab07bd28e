// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/output.h>
#include <talus/observers/phase_times.h>
#include <talus/observers/points_output.h>
#include <talus/observers/profile.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Declare the entries of section Output that choose the files of fields.
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
        "Write, where there are obstacles, their surfaces, and the "
        "facets of these that soil touches, with the traction "
        "there, for ParaView.");
      section.add_parameter(
        "Boxes as cells",
        settings.boxes_as_cells,
        "Write each point as its box, a quad or hex, so that "
        "ParaView shows a continuum, instead of as a dot.");
      section.add_parameter("Format",
                            settings.format,
                            "Files of points, grid and obstacles: " +
                              field_format_documentation() + ".",
                            section.prm,
                            Patterns::Selection(field_format_names()));
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
                  "Folder for all files of the run, made if it is not there; "
                  "files of an earlier run are overwritten.");
    add_parameter("Statistics interval",
                  rows_.interval,
                  "Simulated time between two rows of statistics.csv, and "
                  "between two lines on the terminal [s]. Rows are written at "
                  "the first step that reaches a multiple of it.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Field interval",
                  fields_.interval,
                  "Simulated time between two outputs of points, grid and "
                  "profile [s]; at the first step that reaches a multiple of "
                  "it.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_field_parameters(*this, settings_);
    add_parameter("Runout",
                  settings_.write_runout,
                  "Write what tells the runout: the columns of front and rear "
                  "in statistics.csv, and profile.csv. Not with damping, which "
                  "falsifies the runout.");
    add_parameter("Force averaging time",
                  settings_.averaging_time,
                  "Time over which the forces on obstacles and faces are "
                  "averaged for the columns of the least and largest mean "
                  "force [s]: extremes of single steps are impacts that a "
                  "structure hardly feels. 0: no averaging.",
                  this->prm,
                  Patterns::Double(0.));
    list_observers(obstacles);
  }



  /// A new one is one line here, among those that look when a row is due (rows_)
  /// or when fields are (fields_).
  template <int dim>
  void
  Output<dim>::list_observers(const Obstacles<dim> *obstacles)
  {
    auto statistics = std::make_unique<Statistics<dim>>(obstacles);
    statistics_     = statistics.get();
    rows_.observers.push_back(std::move(statistics));
    fields_.observers.push_back(std::make_unique<Profile<dim>>(obstacles));
    fields_.observers.push_back(std::make_unique<PointsOutput<dim>>());
    fields_.observers.push_back(std::make_unique<GridOutput<dim>>());
  }



  template <int dim>
  void
  Output<dim>::set_folder(const std::string &folder)
  {
    // Through the parameter, so that parameters.prm tells it.
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
                        "expected. Name one there or with --output."));
    AssertThrow(std::none_of(folder_.begin(),
                             folder_.end(),
                             [](const unsigned char c) {
                               return c < ' ' || c == 127 || c == '#' ||
                                      c == '{';
                             }) &&
                  folder_.back() != '\\',
                ExcUser("The output folder '" + folder_ +
                        "' has a name with a control character, as a line "
                        "break, a '#', a '{' or a '\\' at its end, which "
                        "parameters.prm cannot hold. Choose another name with "
                        "Output/Folder or --output."));
    AssertThrow(local_damping == 0 || !settings_.write_runout,
                ExcUser(text("'Damping/Local damping' is ",
                             local_damping,
                             ", but artificial damping falsifies the runout, "
                             "which is to be written. Set Output/Runout = "
                             "false to go without it, or Damping/Local damping "
                             "= 0.")));
  }



  template <int dim>
  void
  Output<dim>::check_observers(const State<dim> &state) const
  {
    for (const Schedule *schedule : {&rows_, &fields_})
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



  /// The first rank makes the folder before anyone opens a file in it, hence
  /// the barrier. parameters.prm comes first: write_file() replaces it only on
  /// success, so a folder that cannot be written stops the run before the
  /// results of an earlier one are touched. Collective.
  template <int dim>
  void
  Output<dim>::begin(const State<dim> &state,
                     const double      end_time,
                     const Beginning   beginning)
  {
    const MPI_Comm communicator = state.grid.communicator();
    if (is_first_rank(communicator))
      {
        make_folder(folder_);
        const std::filesystem::path record =
          std::filesystem::path(folder_) / "parameters.prm";
        const bool had_a_run = is_run_record(record);
        // First, as it shows whether the folder can be written and replaces
        // an earlier file only on success.
        write_run_record(record, this->prm);
        if (beginning == Beginning::resumed)
          remove_remains(folder_);
        else if (had_a_run)
          remove_earlier_results(folder_);
      }
    log_.open(folder_, beginning);
    MPI_Barrier(communicator);

    progress_.begin(state.time, end_time, communicator);
    settings_.folder = folder_;
    for (Schedule *schedule : {&rows_, &fields_})
      {
        // From the time of the state, which a resumed run has loaded: output
        // goes on at the same multiples of the interval as if there had been no
        // stop.
        schedule->times.begin(schedule->interval, state.time);
        for (const auto &observer : schedule->observers)
          if (observer->is_enabled(settings_))
            observer->begin(settings_, state, beginning);
      }
  }



  /// The first row and fields belong to the beginning of the motion, after the
  /// static stages. has_started_ is state of the run: a run that is resumed
  /// later must not write them a second time.
  template <int dim>
  void
  Output<dim>::start(const State<dim> &state)
  {
    if (has_started_)
      return;
    has_started_ = true;
    for (Schedule *schedule : {&rows_, &fields_})
      {
        for (const auto &observer : schedule->observers)
          if (observer->is_enabled(settings_))
            observer->start(state);
        write(*schedule, state);
      }
  }



  /// Both questions are asked before anything is written, as reached() answers
  /// yes only once. Whether output is due follows from the simulated time, so
  /// that all ranks agree without a message.
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
    if (last)
      {
        // Wall times go to the log: the files by which two runs are compared
        // hold none.
        for (const std::string &line :
             phase_times(timer_, state.communicator()))
          log_.say(LogLevel::info, line);
        progress_.finish(state.time, state.points.size());
      }
    return fields_are_due;
  }



  /// The time goes to the phase "output".
  template <int dim>
  void
  Output<dim>::follow(const State<dim> &state)
  {
    const PhaseTimer::Scope scope(timer_, "output");
    for (const Schedule *schedule : {&rows_, &fields_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings_))
          observer->follow(state);
  }



  /// Everything is due at the last step, but for what the same step wrote
  /// already: a row twice would have the mean of an interval of no length.
  template <int dim>
  bool
  Output<dim>::Schedule::is_due(const State<dim> &state, const bool last)
  {
    return times.reached(state.time) || (last && last_step != state.step);
  }



  /// The time goes to the phase "output".
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



  /// Observers that are switched off list theirs, too: what a checkpoint holds
  /// must not depend on parameters that may change when a run is resumed.
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
    for (Schedule *schedule : {&rows_, &fields_})
      for (const auto &observer : schedule->observers)
        observer->list_state(list);
  }



  /// Before any file is opened: begin() cuts files to their length at the
  /// checkpoint, which must not happen to one of them if another is missing. A
  /// file is looked at by the first rank, and its answer is told to all, so
  /// that all of them throw.
  template <int dim>
  void
  Output<dim>::check_resumable(const State<dim> &state) const
  {
    OutputSettings settings = settings_;
    settings.folder         = folder_;
    for (const Schedule *schedule : {&rows_, &fields_})
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
    for (const Schedule *schedule : {&rows_, &fields_})
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



  /// At the end and not before: who removes files while the run goes on may
  /// need the room for what is still to come.
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
               ", which it wrote and somebody has removed or "
               "cut short. All else is complete. Put back what is missing, or "
               "start anew with --overwrite.");
    const std::string first = first_sentence(sentence, communicator);
    AssertThrow(first.empty(), ExcUser(first));
  }



  template <int dim>
  void
  Output<dim>::sync()
  {
    for (const Schedule *schedule : {&rows_, &fields_})
      for (const auto &observer : schedule->observers)
        if (observer->is_enabled(settings_))
          observer->sync();
    // The names of the field files, which a checkpoint lists.
    if (is_first_rank(MPI_COMM_WORLD))
      sync_to_disk(folder_);
  }



  /// A series of its own that is started each time: of several failures only
  /// the last one stays.
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



  /// Not collective: an error may have stopped one rank alone, and to wait for
  /// the others would be to wait for ever. So each rank that gets here writes a
  /// file of its own, as VTU, which needs no common file as HDF5 does.
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

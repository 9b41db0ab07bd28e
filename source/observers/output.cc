#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/run_record.h>
#include <talus/observers/output.h>
#include <talus/observers/phase_times.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Output<dim>::Output(PhaseTimer &timer, Log &log)
    : ParameterAcceptor("/Output")
    , timer_(timer)
    , log_(log)
  {
    add_parameter("Folder",
                  folder_,
                  "Folder for all files of the run, made if it is not there; "
                  "files of an earlier run are overwritten.");
    add_parameter("Statistics interval",
                  statistics_interval_,
                  "Simulated time between two rows of statistics.csv, and "
                  "between two lines on the terminal [s]. Rows are written at "
                  "the first step that reaches a multiple of it.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Field interval",
                  field_interval_,
                  "Simulated time between two outputs of points, grid and "
                  "profile [s]; at the first step that reaches a multiple of "
                  "it.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Write points",
                  write_points_,
                  "Write the points with all their columns for ParaView.");
    add_parameter("Write grid",
                  write_grid_,
                  "Write the cells of the background grid that hold points, "
                  "with nodal mass, velocity and force, for ParaView.");
    add_parameter("Boxes as cells",
                  boxes_as_cells_,
                  "Write each point as its box, a quad or hex, so that "
                  "ParaView shows a continuum, instead of as a dot.");
    add_parameter("Format",
                  format_,
                  "Files of points and grid: " + field_format_documentation() +
                    ".",
                  this->prm,
                  Patterns::Selection(field_format_names()));
    add_parameter("Runout",
                  write_runout_,
                  "Write what tells the runout: the columns of front and rear "
                  "in statistics.csv, and profile.csv. Not with damping, which "
                  "falsifies the runout.");
    parse_parameters_call_back.connect(
      [this]() { statistics_.show_runout(write_runout_); });
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
    AssertThrow(local_damping == 0 || !write_runout_,
                ExcUser(text("'Damping/Local damping' is ",
                             local_damping,
                             ", but artificial damping falsifies the runout, "
                             "which is to be written. Set Output/Runout = "
                             "false to go without it, or Damping/Local damping "
                             "= 0.")));
  }



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
        // First, as it shows whether the folder can be written and replaces
        // an earlier file only on success.
        write_run_record(std::filesystem::path(folder_) / "parameters.prm",
                         this->prm);
      }
    log_.open(folder_, beginning);
    MPI_Barrier(communicator);

    progress_.begin(state.time, end_time, communicator);
    row_times_.begin(statistics_interval_, state.time);
    statistics_.begin(folder_, state, beginning);

    field_times_.begin(field_interval_, state.time);
    if (write_runout_)
      profile_.begin(folder_, state.grid, beginning);
    points_output_.begin(
      folder_, communicator, boxes_as_cells_, format_, beginning);
    grid_output_.begin(folder_, communicator, format_, beginning);
  }



  template <int dim>
  void
  Output<dim>::start(const State<dim> &state)
  {
    if (has_started_)
      return;
    has_started_ = true;
    statistics_.add_first_row(state);
    step_of_last_row_ = state.step;
    write_fields(state);
  }



  template <int dim>
  void
  Output<dim>::list_state(StateList &list)
  {
    list.add("output has started", "-", has_started_, Reduction::equal);
    list.add("step of the last row", "-", step_of_last_row_, Reduction::equal);
    list.add("step of the last fields",
             "-",
             step_of_last_fields_,
             Reduction::equal);
    statistics_.list_state(list);
    profile_.file().list_state(profile_.file_name, list);
    points_output_.list_state(list);
    grid_output_.list_state(list);
  }



  template <int dim>
  void
  Output<dim>::check_resumable(const State<dim> &state) const
  {
    const MPI_Comm                 communicator = state.grid.communicator();
    const std::filesystem::path    folder       = folder_;
    const std::vector<std::string> columns      = statistics_.names(state);
    std::string                    complaint;
    if (is_first_rank(communicator))
      {
        complaint =
          statistics_.file().cannot_resume(folder / statistics_.file_name,
                                           columns);
        if (complaint.empty() && write_runout_)
          complaint = profile_.file().cannot_resume(folder / profile_.file_name,
                                                    profile_.names());
      }
    complaint = first_sentence(complaint, communicator);
    AssertThrow(complaint.empty(), ExcUser(complaint));
  }



  template <int dim>
  void
  Output<dim>::sync()
  {
    points_output_.sync();
    grid_output_.sync();
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    statistics_.file().sync();
    if (write_runout_)
      profile_.file().sync();
    // The names of the field files, which a checkpoint lists.
    sync_to_disk(folder_);
  }



  template <int dim>
  bool
  Output<dim>::observe(const State<dim> &state, const bool last)
  {
    progress_.count_step(state.points.size());
    const bool row_due = row_times_.reached(state.time) ||
                         (last && step_of_last_row_ != state.step);
    const bool fields_due = field_times_.reached(state.time) ||
                            (last && step_of_last_fields_ != state.step);
    if (row_due)
      write_row(state);
    if (fields_due)
      write_fields(state);
    if (last)
      {
        for (const std::string &line :
             phase_times(timer_, state.grid.communicator()))
          log_.say(LogLevel::info, line);
        progress_.finish(state.time, state.points.size());
      }
    return fields_due;
  }



  template <int dim>
  void
  Output<dim>::write_row(const State<dim> &state)
  {
    const PhaseTimer::Scope scope(timer_, "output");
    statistics_.add_row(state);
    progress_.print_line(state.time, state.points.size());
    step_of_last_row_ = state.step;
  }



  template <int dim>
  void
  Output<dim>::write_fields(const State<dim> &state)
  {
    const PhaseTimer::Scope scope(timer_, "output");
    if (write_runout_)
      profile_.add_rows(state);
    if (write_points_)
      points_output_.write(state);
    if (write_grid_)
      grid_output_.write(state);
    step_of_last_fields_ = state.step;
  }



  template <int dim>
  void
  Output<dim>::write_mechanism(const State<dim>          &state,
                               const std::string         &name,
                               const std::vector<double> &mechanism) const
  {
    PointsOutput<dim> output;
    output.begin(folder_,
                 state.grid.communicator(),
                 boxes_as_cells_,
                 format_,
                 Beginning::anew,
                 name);
    output.write(state,
                 {{"mechanism",
                   "-",
                   FieldKind::vector,
                   [&](const unsigned int p, float *values) {
                     for (unsigned int d = 0; d < dim; ++d)
                       values[d] = mechanism[dim * p + d];
                   }}});
  }



  template <int dim>
  std::string
  Output<dim>::write_last_state(const State<dim> &state) const
  {
    const MPI_Comm    communicator = state.grid.communicator();
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

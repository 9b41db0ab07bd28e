#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/parameter_changes.h>
#include <talus/io/run_record.h>
#include <talus/simulation/simulation.h>
#include <talus/version.h>

namespace talus
{
  using namespace dealii;

  /// All state besides points, mesh and parameters. What follows from these is
  /// computed anew by prepare(); nodes hold nothing between the steps.
  template <int dim>
  StateList
  Simulation<dim>::state()
  {
    StateList list;
    list.add("time", "s", time_, Reduction::equal);
    list.add("time step", "s", dt_, Reduction::equal);
    list.add("step", "-", step_, Reduction::equal);
    list.add("gravity work", "J", gravity_work_, Reduction::sum);
    list.add("friction work", "J", boundary_work_.friction, Reduction::sum);
    list.add("contact work", "J", boundary_work_.contact, Reduction::sum);
    list.add("damping work", "J", boundary_work_.damping, Reduction::sum);
    list.add_components("seabed impulse",
                        "N s",
                        boundary_work_.seabed_impulse,
                        dim,
                        Reduction::sum);
    list.add_components(
      "wall impulse", "N s", boundary_work_.wall_impulse, dim, Reduction::sum);
    list.add("mesh changes", "-", n_mesh_changes_, Reduction::equal);
    list.add("repartitions", "-", n_repartitions_, Reduction::equal);
    loading_.list_state(list);
    stages_.list_state(list);
    list.add("standing factor", "-", standing_factor_, Reduction::equal);
    newton_table_.file().list_state(newton_table_.file_name, list);
    splitter_.list_state(list);
    load_balance_.list_state(list);
    output_.list_state(list);
    return list;
  }



  template <int dim>
  void
  Simulation<dim>::resume()
  {
    set_up_laws();
    const MPI_Comm communicator = grid_.communicator();
    resumed_from_ = find_checkpoint(output_.folder(), dim, communicator);
    Hdf5File          file(resumed_from_.path / state_file_name,
                  Hdf5File::Access::read,
                  communicator);
    const std::string parameters = file.read_text("parameters");
    check_read(file);
    check_parameter_changes(parameters, parameters_as_text(this->prm));

    grid_.create(faces_that_may_move(),
                 mesh_tracking_.is_enabled(),
                 boundaries_.periodic_axes());
    grid_.load((resumed_from_.path / mesh_file_name).string());
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int n_ranks_then = resumed_from_.head.n_ranks;
    if (n_ranks == n_ranks_then && n_ranks > 1)
      restore_partition(file);
    prepare();

    // Not found by their positions: on an edge of a cell these leave a choice.
    relocation_.rebuild(points_,
                        load_points(file, grid_.n_owned_cells(), points_));
    settle();
    load_state(file, state());
    splitter_.number_on(Utilities::MPI::this_mpi_process(communicator),
                        n_ranks,
                        n_ranks_then);
    if (n_ranks != n_ranks_then)
      share_out();
    AssertThrow(end_time_ >= time_,
                ExcUser(text("The end time is ",
                             end_time_,
                             " s, but the checkpoint '",
                             resumed_from_.path.string(),
                             "' is at t = ",
                             time_,
                             " s. Give a later 'End time'.")));
    output_.check_resumable(snapshot());
  }



  /// p4est has shared the cells evenly; the sums over ranks are bit by bit the
  /// same only if every rank has what it had.
  template <int dim>
  void
  Simulation<dim>::restore_partition(Hdf5File &file)
  {
    const auto weights = [&]() {
      const auto result =
        load_cell_weights(file, grid_.n_locally_owned_cells());
      check_read(file);
      return result;
    };
    grid_.repartition(weights());
    load_balance_.set_weights(weights());
  }



  template <int dim>
  bool
  Simulation<dim>::is_finished() const
  {
    return !stages_.next_is_static() && time_ >= end_of_run();
  }



  /// A run without dynamics ends where it begins.
  template <int dim>
  double
  Simulation<dim>::end_of_run() const
  {
    return stages_.contain(Stage::dynamics) ? end_time_ : 0.;
  }



  template <int dim>
  void
  Simulation<dim>::begin_run()
  {
    const bool     is_resumed   = !resumed_from_.path.empty();
    const MPI_Comm communicator = grid_.communicator();
    if (is_resumed && is_finished())
      {
        // It may have been killed after its last step.
        checkpoint_.begin(output_.folder(), communicator, resumed_from_.path);
        say(text("The run in '",
                 output_.folder(),
                 "' has reached its end, t = ",
                 time_,
                 " s; there is nothing left to do."));
        return;
      }
    if (!is_resumed && !may_overwrite_)
      check_nothing_unfinished(output_.folder(), communicator);
    const Beginning beginning =
      is_resumed ? Beginning::resumed : Beginning::anew;
    output_.begin(snapshot(), end_time_, beginning);
    if (stages_.have_static() && is_first_rank(communicator))
      newton_table_.begin(output_.folder(), beginning);
    checkpoint_.begin(output_.folder(), communicator, resumed_from_.path);
    remember_signals();
    if (is_resumed)
      note_resume();
    else
      note_start();
    // The checkpoint of a run that was finished must not look finished now.
    if (is_resumed && resumed_from_.head.time >= resumed_from_.head.end_time)
      write_checkpoint();
  }



  template <int dim>
  void
  Simulation<dim>::note_resume()
  {
    const CheckpointHead &head = resumed_from_.head;
    for (const std::string &complaint : resumed_from_.complaints)
      {
        const std::string sentence =
          complaint + " The run goes on from the one before.";
        say(sentence);
        output_.note(sentence, false);
      }
    std::string sentence = text("Resumed at t = ",
                                time_,
                                " s, step ",
                                step_,
                                ", from '",
                                resumed_from_.path.string(),
                                "'.");
    if (head.version != TALUS_VERSION || head.revision != TALUS_GIT_REVISION)
      sentence += text(" That was written by talus ",
                       head.version,
                       ", revision '",
                       head.revision,
                       "', another one than this.");
    output_.note(sentence, true);
    note_time_step();
  }



  /// What this rank wants to happen after the step that begins.
  template <int dim>
  Wish
  Simulation<dim>::own_wish() const
  {
    if (!remembered_signal().empty() || checkpoint_.limit_is_reached())
      return Wish::stop;
    return checkpoint_.is_due(step_ + 1) ? Wish::checkpoint : Wish::none;
  }



  /// Do what the ranks agreed on. Returns whether the run is to stop here.
  template <int dim>
  bool
  Simulation<dim>::act_on(const Wish wish)
  {
    const bool is_end = is_finished();
    const bool is_wanted =
      (is_end ? checkpoint_.is_wanted_at_the_end() : wish != Wish::none);
    if (!is_wanted)
      return false;
    const std::filesystem::path path = write_checkpoint();
    if (is_end || wish != Wish::stop)
      return false;

    const std::string signal = remembered_signal();
    const std::string sentence =
      text("Stopped at t = ",
           time_,
           " s, step ",
           step_,
           !signal.empty() ? ", after the signal " + signal
           : checkpoint_.limit_is_reached()
             ? ", after the limit of wall time"
             : ", after a signal to another rank",
           "; the state is in '",
           path.string(),
           "'. Go on with the same command and --resume.");
    say(sentence);
    output_.note(sentence, false);
    return true;
  }



  template <int dim>
  std::filesystem::path
  Simulation<dim>::write_checkpoint()
  {
    PhaseTimer::Scope scope(timer_, "checkpoint");
    output_.sync();
    std::vector<double> cell_weights = load_balance_.weights();
    cell_weights.resize(grid_.n_owned_cells(), 1.);
    const StateList   list       = state();
    const std::string parameters = parameters_as_text(this->prm);
    return checkpoint_.write(
      {points_, cell_weights, list, parameters, step_, time_, end_of_run()},
      grid_);
  }



  /// Tell the user, whether or not somebody watches.
  template <int dim>
  void
  Simulation<dim>::say(const std::string &sentence)
  {
    if (Utilities::MPI::this_mpi_process(grid_.communicator()) == 0)
      std::cout << sentence << std::endl;
  }



#define INSTANTIATE(dim)                                                         \
  template StateList             Simulation<dim>::state();                       \
  template void                  Simulation<dim>::resume();                      \
  template void                  Simulation<dim>::restore_partition(Hdf5File &); \
  template bool                  Simulation<dim>::is_finished() const;           \
  template double                Simulation<dim>::end_of_run() const;            \
  template void                  Simulation<dim>::begin_run();                   \
  template Wish                  Simulation<dim>::own_wish() const;              \
  template bool                  Simulation<dim>::act_on(Wish);                  \
  template std::filesystem::path Simulation<dim>::write_checkpoint();            \
  template void                  Simulation<dim>::note_resume();                 \
  template void                  Simulation<dim>::say(const std::string &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

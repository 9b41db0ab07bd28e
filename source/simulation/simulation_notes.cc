// The part of Simulation that writes the log.

#include <talus/base/errors.h>
#include <talus/simulation/simulation.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Simulation<dim>::note_start()
  {
    const auto extent  = grid_.extent_of_lattice(grid_.base_level());
    double     n_cells = 1;
    for (const long n : extent)
      n_cells *= n;
    const bool is_uniform =
      (n_cells == grid_.triangulation().n_global_active_cells());
    if (!title_.empty())
      output_.note(title_, true);
    output_.note(text("The mesh fills (",
                      grid_.domain().lower,
                      ") to (",
                      grid_.domain().upper,
                      ") m with ",
                      grid_.triangulation().n_global_active_cells(),
                      " cells",
                      is_uniform ? " of " : ", the smallest of ",
                      grid_.finest_size(),
                      " m; there are ",
                      Utilities::MPI::sum(points_.size(), grid_.communicator()),
                      " points.",
                      grid_.adjustment()),
                 true);
    for (const std::string &note : materials_.notes(grid_.cell_size()))
      output_.note(note, true);
    for (const std::string &note : start_notes_)
      output_.note(note, true);
    if (!trigger_.note().empty())
      output_.note(trigger_.note(), true);
    note_time_step();
  }



  /// What the points of all ranks allow in this state, s. Collective.
  template <int dim>
  double
  Simulation<dim>::allowed_time_step()
  {
    return Utilities::MPI::min(
      time_step_.choose(points_, grid_, materials_, transfer_.box_shape()),
      grid_.communicator());
  }



  template <int dim>
  void
  Simulation<dim>::note_time_step()
  {
    const MPI_Comm     communicator = grid_.communicator();
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(communicator);
    const double       dt       = allowed_time_step();
    std::string        sentence = text(
      "t = ",
      time_,
      " s: the time step is ",
      dt,
      " s, limited by ",
      time_step_.limited_by(points_, grid_, materials_, transfer_.box_shape()),
      ".");
    if (n_mesh_changes_ > 0)
      sentence += text(" The mesh changed ",
                       n_mesh_changes_,
                       " times and has ",
                       grid_.triangulation().n_global_active_cells(),
                       " cells.");
    if (n_ranks > 1)
      sentence += text(" The largest share of points of the ",
                       n_ranks,
                       " ranks is ",
                       LoadBalance<dim>::imbalance(points_, communicator),
                       " times the mean; cells were shared out ",
                       n_repartitions_,
                       " times.");
    output_.note(sentence, step_ == 0);
  }



#define INSTANTIATE(dim)                             \
  template void   Simulation<dim>::note_start();     \
  template void   Simulation<dim>::note_time_step(); \
  template double Simulation<dim>::allowed_time_step();

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

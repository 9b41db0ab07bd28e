// The part of Simulation that tells the log what it does.

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
    note_time_step();
  }



  template <int dim>
  void
  Simulation<dim>::note_time_step()
  {
    const MPI_Comm     communicator = grid_.communicator();
    const BoxShape    &shape        = transfer_.box_shape();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const double       dt =
      Utilities::MPI::min(time_step_.choose(points_, grid_, materials_, shape),
                          communicator);
    std::string sentence =
      text("t = ",
           time_,
           " s: the time step is ",
           dt,
           " s, limited by ",
           time_step_.limited_by(points_, grid_, materials_, shape),
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



  template void
  Simulation<2>::note_start();
  template void
  Simulation<3>::note_start();
  template void
  Simulation<2>::note_time_step();
  template void
  Simulation<3>::note_time_step();
} // namespace talus

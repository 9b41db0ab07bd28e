// The part of Simulation that changes the mesh and its partition.

#include <talus/simulation/simulation.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Simulation<dim>::create_mesh()
  {
    grid_.create(faces_that_may_move(), mesh_tracking_.is_enabled());
    if (mesh_tracking_.is_enabled())
      {
        std::vector<Box<dim>> boxes;
        for (const auto &body : bodies_)
          boxes.push_back(body->bounding_box(grid_.domain()));
        mesh_tracking_.adapt(grid_, boxes);
      }
    else
      grid_.refine();
    prepare();
  }



  /// All that depends on the mesh. Points stay on their rank.
  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    grid_.prepare();
    nodes_.prepare(grid_);
    relocation_.rebuild(points_, grid_);
    nodes_.activate(grid_, relocation_.occupied_cells());
    least_mass_ = transfer_.least_mass(least_density(), grid_.finest_size());
  }



  template <int dim>
  std::array<bool, 2 * dim>
  Simulation<dim>::faces_that_may_move() const
  {
    std::array<bool, 2 * dim> result;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      result[face] = boundaries_.condition(face) == FaceCondition::free;
    return result;
  }



  template <int dim>
  double
  Simulation<dim>::least_density() const
  {
    double result = materials_.of_body(0).density();
    for (unsigned int b = 1; b < bodies_.size(); ++b)
      result = std::min(result, materials_.of_body(b).density());
    return result;
  }



  /// Share the cells out anew among the ranks, by their points.
  template <int dim>
  void
  Simulation<dim>::share_out()
  {
    if (Utilities::MPI::n_mpi_processes(grid_.communicator()) == 1)
      return;
    ++n_repartitions_;
    const auto cells = load_balance_.repartition(grid_, points_);
    nodes_.prepare(grid_);
    relocation_.rebuild(points_, cells);
    nodes_.activate(grid_, relocation_.occupied_cells());
  }



  template <int dim>
  void
  Simulation<dim>::adapt_mesh()
  {
    TimerOutput::Scope scope(timer_, "mesh");
    if (mesh_is_urgent_ ||
        (mesh_tracking_.is_enabled() && mesh_tracking_.is_due(step_)))
      if (mesh_tracking_.adapt(grid_, relocation_.occupied_cells()))
        {
          ++n_mesh_changes_;
          prepare();
          share_out();
        }
    if (load_balance_.is_due(points_, step_, grid_.communicator()))
      share_out();
  }



#define INSTANTIATE(dim)                                                    \
  template void                      Simulation<dim>::create_mesh();        \
  template void                      Simulation<dim>::prepare();            \
  template std::array<bool, 2 * dim> Simulation<dim>::faces_that_may_move() \
    const;                                                                  \
  template double Simulation<dim>::least_density() const;                   \
  template void   Simulation<dim>::share_out();                             \
  template void   Simulation<dim>::adapt_mesh();

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

// The part of Simulation that changes the mesh and its partition.

#include <talus/simulation/simulation.h>
#include <talus/transfer/weights.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Simulation<dim>::create_mesh()
  {
    grid_.create(faces_that_may_move(),
                 mesh_tracking_.is_enabled(),
                 boundaries_.periodic_axes());
    if (mesh_tracking_.is_enabled())
      {
        std::vector<Box<dim>> boxes;
        for (const auto &body : bodies_)
          boxes.push_back(body->bounding_box(grid_.domain_before_growth()));
        mesh_tracking_.adapt(grid_, boxes);
      }
    else
      grid_.refine();
    prepare();
  }



  namespace
  {
    /// Coverage and reach, after a change of the mesh: every point lies in its
    /// cell, or beyond a wall at most half a cell outside, and its weights sum
    /// to one (which weights_of_point() asserts). (Used in Debug only.)
    template <int dim>
    [[maybe_unused]] bool
    points_are_covered(const Points<dim> &points,
                       const Grid<dim>   &grid,
                       const BoxShape    &shape)
    {
      std::vector<NodeWeight<dim>> weights;
      for (const Segment &segment : points.segments())
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            const Cell<dim> &cell = grid.cells()[segment.cell];
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double xi =
                  (points.data(points.position, d)[p] - cell.lower[d]) /
                  cell.size;
                const bool first = cell.lower[d] <= grid.domain().lower[d];
                const bool last =
                  cell.lower[d] + 1.5 * cell.size > grid.domain().upper[d];
                if (!(xi >= (first ? -0.5 : -1e-12) &&
                      xi <= (last ? 1.5 : 1. + 1e-12)))
                  return false;
              }
            weights_of_point(points, grid, shape, segment.cell, p, weights);
          }
      return shape.most_half <= 0.5;
    }
  } // namespace



  /// All that depends on the mesh. Points stay on their rank.
  template <int dim>
  void
  Simulation<dim>::prepare()
  {
    grid_.prepare();
    nodes_.prepare(grid_);
    boundaries_.locate_nodes(grid_);
    relocation_.rebuild(points_, grid_);
    settle();
    least_mass_ = transfer_.least_mass(least_density(), grid_.finest_size());
  }



  /// The points are in their new cells.
  template <int dim>
  void
  Simulation<dim>::settle()
  {
    nodes_.activate(grid_, relocation_.occupied_cells());
    Assert(points_are_covered(points_, grid_, transfer_.box_shape()),
           ExcMessage(
             "After a change of the mesh a point is not in its cell."));
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
    boundaries_.locate_nodes(grid_);
    relocation_.rebuild(points_, cells);
    settle();
  }



  template <int dim>
  void
  Simulation<dim>::adapt_mesh()
  {
    PhaseTimer::Scope scope(timer_, "mesh");
    const auto       &occupied = relocation_.occupied_cells();
    if (mesh_tracking_.is_enabled() &&
        (mesh_tracking_.is_due(step_) ||
         Utilities::MPI::logical_or(mesh_tracking_.is_urgent(grid_, occupied),
                                    grid_.communicator())))
      if (mesh_tracking_.adapt(grid_, occupied))
        {
          ++n_mesh_changes_;
          prepare();
          share_out();
        }
    if (load_balance_.is_due(step_, grid_.communicator()))
      {
        splitter_.check_total(
          Utilities::MPI::sum(1. * points_.size(), grid_.communicator()));
        if (load_balance_.is_needed(points_, grid_.communicator()))
          share_out();
      }
  }



#define INSTANTIATE(dim)                                                    \
  template void                      Simulation<dim>::create_mesh();        \
  template void                      Simulation<dim>::prepare();            \
  template void                      Simulation<dim>::settle();             \
  template std::array<bool, 2 * dim> Simulation<dim>::faces_that_may_move() \
    const;                                                                  \
  template double Simulation<dim>::least_density() const;                   \
  template void   Simulation<dim>::share_out();                             \
  template void   Simulation<dim>::adapt_mesh();

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/periodicity.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // The relocation calls any() for each point: stored once.
  template <int dim>
  Periodicity<dim>::Periodicity(const std::array<bool, dim> &axes,
                                const Box<dim>              &domain)
    : axes_(axes)
    , any_(std::find(axes.begin(), axes.end(), true) != axes.end())
    , domain_(domain)
  {
    for (unsigned int d = 0; d < dim; ++d)
      length_[d] = domain.length(d);
  }



  template <int dim>
  void
  Periodicity<dim>::wrap(Lattice<dim> &place, const Lattice<dim> &extent) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (axes_[d])
        // The remainder of a negative number is negative in C++.
        place[d] = (place[d] % extent[d] + extent[d]) % extent[d];
  }



  // Cells at the opposite face become ghosts if they belong to another rank,
  // and points may cross the face in a step as in the interior.
  template <int dim>
  void
  Periodicity<dim>::join_faces(
    parallel::distributed::Triangulation<dim> &triangulation) const
  {
    std::vector<
      GridTools::PeriodicFacePair<typename Triangulation<dim>::cell_iterator>>
      pairs;
    for (unsigned int d = 0; d < dim; ++d)
      if (axes_[d])
        GridTools::collect_periodic_faces(
          triangulation, 2 * d, 2 * d + 1, d, pairs);
    triangulation.add_periodicity(pairs);
  }



  // Twins are matched by position: the twin of a node on several faces is found
  // directly, even if this rank knows little of the mesh between them.
  template <int dim>
  std::map<types::global_dof_index, types::global_dof_index>
  Periodicity<dim>::find_twins(const DoFHandler<dim> &dof_handler,
                               const double           size) const
  {
    Lattice<dim> extent;
    for (unsigned int d = 0; d < dim; ++d)
      extent[d] = std::lround(length_[d] / size);
    std::map<Lattice<dim>, types::global_dof_index> lower, upper;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (!cell->is_artificial() && cell->at_boundary())
        for (const unsigned int v : cell->vertex_indices())
          {
            Lattice<dim> place;
            bool         is_upper = false;
            for (unsigned int d = 0; d < dim; ++d)
              {
                place[d] =
                  std::lround((cell->vertex(v)[d] - domain_.lower[d]) / size);
                is_upper = is_upper || (axes_[d] && place[d] == extent[d]);
              }
            // All other boundary nodes may be twins.
            (is_upper ? upper : lower)[place] = cell->vertex_dof_index(v, 0);
          }

    std::map<types::global_dof_index, types::global_dof_index> twins;
    for (const auto &[place, node] : upper)
      {
        Lattice<dim> at = place;
        wrap(at, extent);
        if (const auto twin = lower.find(at); twin != lower.end())
          twins[node] = twin->second;
      }
    return twins;
  }



  template class Periodicity<2>;
  template class Periodicity<3>;
} // namespace talus

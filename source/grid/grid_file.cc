// SPDX-License-Identifier: LGPL-2.1-or-later
// The part of Grid that saves the mesh and loads it.

#include <talus/grid/grid.h>

#include <deal.II/grid/tria_iterator.h>

namespace talus
{
  using namespace dealii;

  // The mesh is state: it follows from where the soil was when the mesh was
  // last adapted, not from where it is now.
  template <int dim>
  void
  Grid<dim>::save(const std::string &path) const
  {
    triangulation_.save(path);
  }



  template <int dim>
  void
  Grid<dim>::load(const std::string &path)
  {
    triangulation_.load(path);
  }



  // p4est cuts its curve where the sums of the weights ask for it, so the same
  // weights give the same cells to the same ranks: that is how a resumed run
  // finds the partition it had, and with it the order of all sums. deal.II asks
  // for weights by its own cells, which are in another order than ours.
  template <int dim>
  void
  Grid<dim>::repartition(const std::vector<double> &weights)
  {
    AssertDimension(weights.size(), n_locally_owned_cells());
    std::vector<unsigned int> weight_of_active_cell(
      triangulation_.n_active_cells(), 0);
    auto weight = weights.begin();
    for (const auto &cell : cells_in_order())
      if (cell->is_locally_owned())
        weight_of_active_cell[cell->active_cell_index()] =
          static_cast<unsigned int>(*weight++);

    // For this one time: later repartitions have other weights.
    const auto connection = triangulation_.signals.weight.connect(
      [&](const typename Triangulation<dim>::cell_iterator &cell,
          const typename Triangulation<dim>::CellStatus) {
        return weight_of_active_cell[cell->active_cell_index()];
      });
    triangulation_.repartition();
    connection.disconnect();
  }



#define INSTANTIATE(dim)                                    \
  template void Grid<dim>::save(const std::string &) const; \
  template void Grid<dim>::load(const std::string &);       \
  template void Grid<dim>::repartition(const std::vector<double> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

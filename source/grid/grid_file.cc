// The part of Grid that saves the mesh and loads it.

#include <talus/grid/grid.h>

#include <deal.II/grid/tria_iterator.h>

namespace talus
{
  using namespace dealii;

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

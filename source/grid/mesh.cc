// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/mesh.h>

#include <talus/base/assertion.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // Neighbours differ by at most one level, also across corners, since the
  // boxes of points reach across corners: the cells touching a cell are on at
  // most three levels (CellCache::find_touching_cells()). Cells change their
  // rank only by explicit repartitioning: points travel with their cells
  // (LoadBalance) or are sent later (BackgroundMesh).
  template <int dim>
  Mesh<dim>::Mesh(MPI_Comm communicator)
    : triangulation_(
        communicator,
        typename Triangulation<dim>::MeshSmoothing(
          Triangulation<dim>::limit_level_difference_at_vertices),
        parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
  {}



  template <int dim>
  void
  Mesh<dim>::create(const std::array<bool, 2 * dim> &may_move,
                    const bool                       grow,
                    const std::array<bool, dim>     &periodic)
  {
    const auto trees = this->lay_out(triangulation_.get_communicator(),
                                     may_move,
                                     grow,
                                     periodic);
    triangulation_.clear();
    GridGenerator::subdivided_hyper_rectangle(triangulation_,
                                              trees,
                                              this->domain().lower,
                                              this->domain().upper,
                                              /*colorize=*/true);
    if (this->periodicity().any())
      this->periodicity().join_faces(triangulation_);
  }



  // First refine all cells to h, which needs no communication, and distribute
  // the cells; then refine the boxes, which may lie on one rank.
  template <int dim>
  void
  Mesh<dim>::refine()
  {
    triangulation_.refine_global(this->base_level());
    triangulation_.repartition();
    if (this->has_refinement_boxes())
      refine(
        [&](const Lattice &, const unsigned int level) {
          return level < this->base_level();
        },
        true);
  }



  /// Flag cells to be refined or coarsened. Return the numbers of flagged cells
  /// on all ranks, {refine, coarsen}. Flags follow from the current content of
  /// a cell, not from its history: a cell is coarsened if its parent needs no
  /// refinement. Two runs that arrive at the same soil have the same mesh.
  template <int dim>
  std::array<double, 2>
  Mesh<dim>::flag_cells(const WantsFiner &wants_finer)
  {
    const auto wants = [&](const Lattice &place, const unsigned int level) {
      return this->box_wants_finer(place, level) || wants_finer(place, level);
    };
    std::array<double, 2> n_flagged{};
    for (const auto &cell : triangulation_.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int level = cell->level();
          Lattice            place = this->lattice_place(cell->center(), level);
          if (wants(place, level))
            {
              cell->set_refine_flag();
              ++n_flagged[0];
            }
          else if (level > 0)
            {
              for (auto &p : place)
                p /= 2;
              if (!wants(place, level - 1))
                {
                  cell->set_coarsen_flag();
                  ++n_flagged[1];
                }
            }
        }
    const ArrayView<const double> own(n_flagged);
    const ArrayView<double>       sums(n_flagged);
    Utilities::MPI::sum(own, triangulation_.get_communicator(), sums);
    return n_flagged;
  }



  /// Return whether any rank can coarsen any flagged cell. Some flagged cells
  /// always stay: next to smaller cells, or without their siblings on this
  /// rank. The test avoids a useless coarsening, after which deal.II copies all
  /// cells from p4est. If the answer is true, the coarsening flags are
  /// restored. Collective.
  template <int dim>
  bool
  Mesh<dim>::can_join_cells()
  {
    std::vector<bool> flags;
    triangulation_.save_coarsen_flags(flags);
    triangulation_.prepare_coarsening_and_refinement();
    bool can = false;
    for (const auto &cell : triangulation_.active_cell_iterators())
      {
        can = can || (cell->is_locally_owned() && cell->coarsen_flag_set());
        // deal.II also sets refinement flags on artificial cells.
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
      }
    can = Utilities::MPI::logical_or(can, triangulation_.get_communicator());
    if (can)
      triangulation_.load_coarsen_flags(flags);
    return can;
  }



  // deal.II changes cells by one level at a time, and keeps neighbours within a
  // factor of two by refining more or coarsening fewer cells than flagged:
  // repeat until nothing changes. Each round visits every cell once. Counts are
  // global, so all ranks stop in the same round.
  template <int dim>
  bool
  Mesh<dim>::refine(const WantsFiner &wants_finer, const bool spread)
  {
    bool changed = false;
    while (true)
      {
        const auto n_before = triangulation_.n_global_active_cells();
        const auto [n_divided, n_joined] = flag_cells(wants_finer);
        if (n_divided == 0 && (n_joined == 0 || !can_join_cells()))
          return changed;
        if (n_divided > 0)
          this->check_memory(n_before +
                             (GeometryInfo<dim>::max_children_per_cell - 1.) *
                               n_divided);
        triangulation_.execute_coarsening_and_refinement();
        // deal.II tests the cells known to a rank, p4est the whole mesh: p4est
        // may reject all changes.
        if (n_divided == 0 &&
            n_before == triangulation_.n_global_active_cells())
          return changed;
        changed = true;
        // Only before points exist: points would stay on the former owner of
        // their cell.
        if (spread && Utilities::MPI::n_mpi_processes(communicator()) > 1)
          triangulation_.repartition();
      }
  }



  // The mesh is part of the state: it follows from the position of the soil at
  // the last adaptation, not from the current position.
  template <int dim>
  void
  Mesh<dim>::save(const std::string &path) const
  {
    triangulation_.save(path);
  }



  template <int dim>
  void
  Mesh<dim>::load(const std::string &path)
  {
    triangulation_.load(path);
  }



  // p4est cuts its curve at fixed sums of weights, so the same weights give the
  // same partition: a resumed run restores the partition, and with it the order
  // of all sums. deal.II asks for weights in its own order of cells.
  template <int dim>
  void
  Mesh<dim>::repartition(const std::vector<double> &weights)
  {
    TalusAssert(weights.size() == n_locally_owned_cells(),
                dealii::ExcDimensionMismatch(weights.size(),
                                             n_locally_owned_cells()));
    std::vector<unsigned int> weight_of_active_cell(
      triangulation_.n_active_cells(), 0);
    auto weight = weights.begin();
    for (const auto &cell : cells_in_order())
      if (cell->is_locally_owned())
        weight_of_active_cell[cell->active_cell_index()] =
          static_cast<unsigned int>(*weight++);

    // Connected for one repartitioning: later ones use other weights.
    const auto connection = triangulation_.signals.weight.connect(
      [&](const typename Triangulation<dim>::cell_iterator &cell,
          const typename Triangulation<dim>::CellStatus) {
        return weight_of_active_cell[cell->active_cell_index()];
      });
    triangulation_.repartition();
    connection.disconnect();
  }



  namespace
  {
    /// Append the active descendants of a cell, depth first, along p4est's
    /// curve.
    template <int dim>
    void
    append_active(
      const typename Triangulation<dim>::cell_iterator               &cell,
      std::vector<typename Triangulation<dim>::active_cell_iterator> &cells)
    {
      if (cell->is_active())
        {
          if (!cell->is_artificial())
            cells.push_back(cell);
          return;
        }
      for (unsigned int child = 0; child < cell->n_children(); ++child)
        append_active<dim>(cell->child(child), cells);
    }
  } // namespace



  // The order of cells in deal.II depends on the history of the mesh. Results
  // must not: otherwise a resumed run would differ from an uninterrupted run.
  // Cells are therefore sorted along the curve of p4est, which also keeps cells
  // that are close in space close in memory.
  template <int dim>
  std::vector<typename Triangulation<dim>::active_cell_iterator>
  Mesh<dim>::cells_in_order() const
  {
    std::vector<typename Triangulation<dim>::active_cell_iterator> cells;
    for (const auto tree :
         triangulation_.get_p4est_tree_to_coarse_cell_permutation())
      append_active<dim>(
        typename Triangulation<dim>::cell_iterator(&triangulation_, 0, tree),
        cells);
    std::stable_partition(cells.begin(), cells.end(), [](const auto &cell) {
      return cell->is_locally_owned();
    });
    return cells;
  }



  template class Mesh<2>;
  template class Mesh<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/grid/grid.h>
#include <talus/grid/nodal_exchange.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  const std::array<std::string, 6> face_names = {
    {"Left", "Right", "Bottom", "Top", "Back", "Front"}};

  // Neighbours differ by one level at most across corners, too, since the boxes
  // of the points reach across them: so the cells that touch a cell are of
  // three levels (find_touching_cells()). Cells change their rank only when we
  // ask for it: points travel with them (LoadBalance), or wait to be sent
  // (BackgroundMesh).
  template <int dim>
  Grid<dim>::Grid(MPI_Comm communicator)
    : ParameterAcceptor("/Grid")
    , triangulation_(
        communicator,
        typename Triangulation<dim>::MeshSmoothing(
          Triangulation<dim>::limit_level_difference_at_vertices),
        parallel::distributed::Triangulation<dim>::no_automatic_repartitioning)
    , fe_(1)
    , dof_handler_(triangulation_)
  {
    for (unsigned int d = 0; d < dim; ++d)
      upper_corner_[d] = 1.;
    add_parameter("Lower corner",
                  lower_corner_,
                  "Corner of the box that the mesh fills, with the smallest "
                  "coordinates [m].");
    add_parameter("Upper corner",
                  upper_corner_,
                  "Corner of the box that the mesh fills, with the largest "
                  "coordinates [m].");
    add_parameter("Cell size",
                  cell_size_,
                  "Edge h of the cells, exact [m]. Where an extent of the box "
                  "is no multiple of it, the upper face moves outwards, which "
                  "is refused for walls.",
                  this->prm,
                  Patterns::Double(1e-12));
    add_parameter("Coarsest level",
                  coarsest_level_,
                  "The mesh is a forest of trees with 2^L cells per axis; L is "
                  "the largest number up to this one that divides the cells of "
                  "every axis. With 'Mesh tracking' it is how much coarser far "
                  "cells may be, and faces that are free, at the upper end of "
                  "an axis, move outwards where that takes it.",
                  this->prm,
                  Patterns::Integer(0, 10));
    add_parameter(
      "Initial refinement",
      initial_refinement_,
      "Halve all cells this many times: h is 'Cell size' divided by "
      "2^n.",
      this->prm,
      Patterns::Integer(0, 10));
    add_parameter(
      "Refinement boxes",
      refinement_boxes_,
      "Boxes with smaller cells, separated by bars (|), each as "
      "lower corner; upper corner; number of times the cells are "
      "halved there: -40,0; 280,0.4; 1 makes a layer of 0.4 m at the "
      "seabed finer. Corners in m; neighbouring cells differ by at "
      "most a factor of two.");
  }



  template <int dim>
  void
  Grid<dim>::check() const
  {
    for (unsigned int d = 0; d < dim; ++d)
      AssertThrow(upper_corner_[d] > lower_corner_[d],
                  ExcUser(text("Grid/Upper corner (",
                               upper_corner_,
                               ") must lie above Grid/Lower corner (",
                               lower_corner_,
                               ") in every coordinate; coordinate ",
                               d,
                               " does not.")));
  }



  // The flat cache. The transfer asks millions of times a second which nodes
  // are around a place; deal.II's iterators answer that through several tables,
  // and find neighbours of the same size only level by level. So what is needed
  // is written down once per mesh: two lines of the cache per cell in 2-D,
  // seven in 3-D, and a pass over all cells whenever the mesh changes.
  //
  // The order of the calls: nodes need numbers before cells can list them, own
  // nodes of all cells are there before patches are put together from them, and
  // messages between ranks need the lists of owned and ghost nodes.
  template <int dim>
  void
  Grid<dim>::prepare()
  {
    number_nodes();
    find_ghost_nodes();
    list_cells();
    touching_.clear();
    // Ghosts are not linked: no point is in them, and not all of their
    // neighbours are known here.
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      link_cell(c);
    NodalExchange<dim> exchange;
    exchange.prepare(*this, 2);
    mark_boundary_nodes(exchange);
    find_larger_cells(exchange);
  }



  namespace
  {
    /// Depth first, as p4est's curve goes.
    template <int dim>
    void
    append_active(
      const typename DoFHandler<dim>::cell_iterator               &cell,
      std::vector<typename DoFHandler<dim>::active_cell_iterator> &cells)
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



  // deal.II's own order of the cells depends on how the mesh came about.
  // Results must not depend on what the mesh looked like before, or a resumed
  // run would differ from one that was not interrupted: so cells go along
  // p4est's curve. It also keeps cells close in memory that are close in space.
  template <int dim>
  std::vector<typename DoFHandler<dim>::active_cell_iterator>
  Grid<dim>::cells_in_order() const
  {
    std::vector<typename DoFHandler<dim>::active_cell_iterator> cells;
    for (const auto tree :
         triangulation_.get_p4est_tree_to_coarse_cell_permutation())
      append_active<dim>(typename DoFHandler<dim>::cell_iterator(
                           &triangulation_, 0, tree, &dof_handler_),
                         cells);
    std::stable_partition(cells.begin(), cells.end(), [](const auto &cell) {
      return cell->is_locally_owned();
    });
    return cells;
  }



  /// Fill what a cell knows of itself: place, size and own nodes; and the lists
  /// that go with it. Neighbours come in link_cell().
  template <int dim>
  void
  Grid<dim>::list_cells()
  {
    const auto cells = cells_in_order();
    cells_.clear();
    level_of_cell_.clear();
    cell_map_.clear();
    cell_map_.reserve(cells.size());
    owner_of_ghost_.clear();
    n_owned_cells_ = 0;
    index_of_active_cell_.assign(triangulation_.n_active_cells(),
                                 numbers::invalid_unsigned_int);
    std::vector<types::global_dof_index> dofs(fe_.n_dofs_per_cell());
    for (const auto &cell : cells)
      {
        const unsigned int level = cell->level();
        const Lattice      place = lattice_place(cell->center(), level);
        Cell<dim>          data;
        data.size = tree_size_ / (1u << level);
        // By the place in the lattice and not by deal.II's vertices, which come
        // from halving after halving: the same whatever the mesh was before.
        for (unsigned int d = 0; d < dim; ++d)
          data.lower[d] = domain_.lower[d] + place[d] * data.size;
        data.uniform = false;
        data.patch.fill(numbers::invalid_unsigned_int);
        data.neighbors.fill(numbers::invalid_unsigned_int);
        cell->get_dof_indices(dofs);
        for (unsigned int v = 0; v < dofs.size(); ++v)
          {
            unsigned int at = 0;
            for (unsigned int d = 0; d < dim; ++d)
              at += (1 + ((v >> d) & 1)) * power(4, d);
            data.patch[at] = local_node(dofs[v]);
          }
        if (cell->is_locally_owned())
          ++n_owned_cells_;
        else
          owner_of_ghost_.push_back(cell->subdomain_id());
        index_of_active_cell_[cell->active_cell_index()] = cells_.size();
        cell_map_[key_of_place<dim>(place, level)]       = cells_.size();
        cells_.push_back(data);
        level_of_cell_.push_back(level);
      }
    neighbor_ranks_.assign(owner_of_ghost_.begin(), owner_of_ghost_.end());
    std::sort(neighbor_ranks_.begin(), neighbor_ranks_.end());
    neighbor_ranks_.erase(std::unique(neighbor_ranks_.begin(),
                                      neighbor_ranks_.end()),
                          neighbor_ranks_.end());
    finest_size_ = tree_size_ / (1u << (triangulation_.n_global_levels() - 1));
  }



  /// Indices of cells are those of one rank and one mesh; the place in the
  /// lattice of a level is the same for all.
  template <int dim>
  unsigned long
  Grid<dim>::key_of_cell(const unsigned int c) const
  {
    return key_of_place<dim>(place_of_cell(c), level_of_cell_[c]);
  }



  template <int dim>
  unsigned int
  Grid<dim>::cell_of_key(const unsigned long key) const
  {
    const auto it = cell_map_.find(key);
    return it == cell_map_.end() ? numbers::invalid_unsigned_int : it->second;
  }



  template <int dim>
  typename Grid<dim>::Lattice
  Grid<dim>::extent_of_lattice(const unsigned int level) const
  {
    const double size = tree_size_ / (1u << level);
    Lattice      extent;
    for (unsigned int d = 0; d < dim; ++d)
      extent[d] = std::lround(domain_.length(d) / size);
    return extent;
  }



  // Where a place lies outside of the mesh the nearest cell: a point that dips
  // into a wall belongs to the cell at the wall. How far it may do so,
  // Relocation checks.
  template <int dim>
  typename Grid<dim>::Lattice
  Grid<dim>::lattice_place(const Point<dim> &x, const unsigned int level) const
  {
    const double  size   = tree_size_ / (1u << level);
    const Lattice extent = extent_of_lattice(level);
    Lattice       place;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double at = std::floor((x[d] - domain_.lower[d]) / size);
        // Compared as doubles: a point may be anywhere, or not a number.
        place[d] = !(at > 0.)            ? 0
                   : at < extent[d] - 1. ? static_cast<long>(at)
                                         : extent[d] - 1;
      }
    return place;
  }



  // By the centre, which round-off cannot move into a neighbour.
  template <int dim>
  typename Grid<dim>::Lattice
  Grid<dim>::place_of_cell(const unsigned int c) const
  {
    Point<dim> center = cells_[c].lower;
    for (unsigned int d = 0; d < dim; ++d)
      center[d] += 0.5 * cells_[c].size;
    return lattice_place(center, level_of_cell_[c]);
  }



  /// The active cell of this level at this place; invalid_unsigned_int if there
  /// is none, or none that this rank knows. Negative numbers would run into the
  /// other fields of the key; places beyond the upper end have keys that no
  /// cell has.
  template <int dim>
  unsigned int
  Grid<dim>::cell_at(const Lattice &place, const unsigned int level) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (place[d] < 0)
        return numbers::invalid_unsigned_int;
    return cell_of_key(key_of_place<dim>(place, level));
  }



  // From the smallest cells on: most points are in one of these. One look into
  // a hash table per level, whatever the number of cells. It is for points that
  // are new or went astray; Relocation::locate() asks the neighbours first.
  template <int dim>
  unsigned int
  Grid<dim>::find_cell(Point<dim> x) const
  {
    for (int level = triangulation_.n_levels() - 1; level >= 0; --level)
      {
        const unsigned int c = cell_at(lattice_place(x, level), level);
        if (c != numbers::invalid_unsigned_int)
          return c;
      }
    return numbers::invalid_unsigned_int;
  }



  template class Grid<2>;
  template class Grid<3>;
} // namespace talus

#include <talus/base/errors.h>
#include <talus/grid/grid.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  const std::array<std::string, 6> face_names = {
    {"Left", "Right", "Bottom", "Top", "Back", "Front"}};

  namespace
  {
    /// One number for a place in the lattice of a level: 6 bits for the level,
    /// the rest shared by the axes.
    template <int dim>
    unsigned long
    key(const std::array<long, dim> &place, const unsigned int level)
    {
      constexpr unsigned int bits   = 58 / dim;
      unsigned long          result = level;
      for (unsigned int d = 0; d < dim; ++d)
        result = (result << bits) | static_cast<unsigned long>(place[d]);
      return result;
    }
  } // namespace



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
                  "every axis.",
                  this->prm,
                  Patterns::Integer(0, 10));
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



  template <int dim>
  void
  Grid<dim>::fit_domain(const std::array<bool, 2 * dim> &may_move)
  {
    adjustment_.clear();
    domain_ = {lower_corner_, upper_corner_};
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double exact = domain_.length(d) / cell_size_;
        const double whole = std::round(exact);
        if (whole >= 1 && std::abs(exact - whole) <= 1e-9 * whole)
          {
            n_cells_per_axis_[d] = static_cast<unsigned int>(whole);
            continue;
          }
        AssertThrow(exact > 1,
                    ExcUser(text("The mesh is only ",
                                 domain_.length(d),
                                 " m long along axis ",
                                 d,
                                 ", less than one cell of Grid/Cell size = ",
                                 cell_size_,
                                 " m. Choose smaller cells or a larger box.")));
        const unsigned int face = 2 * d + 1;
        AssertThrow(may_move[face],
                    ExcUser(
                      text("The mesh is ",
                           domain_.length(d),
                           " m long along axis ",
                           d,
                           ", which is no multiple of Grid/Cell size = ",
                           cell_size_,
                           " m, and its face '",
                           face_names[face],
                           "' is not free, so it must not move. Choose another "
                           "cell size or corner.")));
        n_cells_per_axis_[d] = static_cast<unsigned int>(std::ceil(exact));
        domain_.upper[d] = domain_.lower[d] + n_cells_per_axis_[d] * cell_size_;
        adjustment_ += text(" The face '",
                            face_names[face],
                            "' was moved outwards from ",
                            upper_corner_[d],
                            " m to ",
                            domain_.upper[d],
                            " m, so that the cells are ",
                            cell_size_,
                            " m long.");
      }
  }



  template <int dim>
  unsigned int
  Grid<dim>::refinement_that_divides() const
  {
    unsigned int level = coarsest_level_;
    for (unsigned int d = 0; d < dim; ++d)
      while (n_cells_per_axis_[d] % (1u << level) != 0)
        --level;
    return level;
  }



  template <int dim>
  unsigned int
  Grid<dim>::create_trees(const std::array<bool, 2 * dim> &may_move)
  {
    fit_domain(may_move);
    double n_cells = 1;
    for (const unsigned int n : n_cells_per_axis_)
      n_cells *= n;
    AssertThrow(n_cells < 2e9,
                ExcUser(text("The mesh would have ",
                             n_cells,
                             " cells. Choose a larger Grid/Cell size than ",
                             cell_size_,
                             " m or a smaller box.")));

    const unsigned int        level = refinement_that_divides();
    std::vector<unsigned int> trees(dim);
    for (unsigned int d = 0; d < dim; ++d)
      trees[d] = n_cells_per_axis_[d] >> level;
    tree_size_ = cell_size_ * (1u << level);

    triangulation_.clear();
    GridGenerator::subdivided_hyper_rectangle(
      triangulation_, trees, domain_.lower, domain_.upper, /*colorize=*/true);
    return level;
  }



  template <int dim>
  void
  Grid<dim>::create(const std::array<bool, 2 * dim> &may_move)
  {
    triangulation_.refine_global(create_trees(may_move));
    triangulation_.repartition();
  }



  template <int dim>
  void
  Grid<dim>::prepare()
  {
    number_nodes();
    find_ghost_nodes();
    list_cells();
    touching_.clear();
    for (unsigned int c = 0; c < n_owned_cells_; ++c)
      link_cell(c);
    mark_boundary_nodes();
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
        cell_map_[key<dim>(place, level)]                = cells_.size();
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



  template <int dim>
  unsigned long
  Grid<dim>::key_of_cell(const unsigned int c) const
  {
    return key<dim>(place_of_cell(c), level_of_cell_[c]);
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
  Grid<dim>::lattice_extent(const double size) const
  {
    Lattice extent;
    for (unsigned int d = 0; d < dim; ++d)
      extent[d] = std::lround(domain_.length(d) / size);
    return extent;
  }



  template <int dim>
  typename Grid<dim>::Lattice
  Grid<dim>::lattice_place(const Point<dim> &x, const unsigned int level) const
  {
    const double  size   = tree_size_ / (1u << level);
    const Lattice extent = lattice_extent(size);
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



  template <int dim>
  typename Grid<dim>::Lattice
  Grid<dim>::place_of_cell(const unsigned int c) const
  {
    Point<dim> center = cells_[c].lower;
    for (unsigned int d = 0; d < dim; ++d)
      center[d] += 0.5 * cells_[c].size;
    return lattice_place(center, level_of_cell_[c]);
  }



  template <int dim>
  unsigned int
  Grid<dim>::cell_at(const Lattice &place, const unsigned int level) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (place[d] < 0)
        return numbers::invalid_unsigned_int;
    return cell_of_key(key<dim>(place, level));
  }



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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/facets.h>
#include <talus/geometry/cut_box.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    Box<dim>
    box_of(const Cell<dim> &cell)
    {
      Box<dim> box{cell.lower, cell.lower};
      for (unsigned int d = 0; d < dim; ++d)
        box.upper[d] += cell.size;
      return box;
    }



    template <int dim>
    Point<dim>
    centre_of(const Cell<dim> &cell)
    {
      Point<dim> x = cell.lower;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.5 * cell.size;
      return x;
    }



    /// A surface at this distance of the centre may be in the cell.
    template <int dim>
    bool
    may_cut(const double distance, const Cell<dim> &cell)
    {
      return std::abs(distance) <=
             0.5 * std::sqrt(double(dim)) * cell.size * (1. + 1e-6);
    }



    /// The own nodes of a cell, x fastest.
    template <int dim>
    std::array<unsigned int, Facet<dim>::n_nodes>
    nodes_of(const Cell<dim> &cell)
    {
      std::array<unsigned int, Facet<dim>::n_nodes> nodes;
      for (unsigned int v = 0; v < nodes.size(); ++v)
        {
          unsigned int at = 0;
          for (unsigned int d = 0; d < dim; ++d)
            at += (1 + ((v >> d) & 1)) * power(4, d);
          nodes[v] = cell.patch[at];
        }
      return nodes;
    }



    /// Place of own node @p v.
    template <int dim>
    Point<dim>
    place_of_node(const Cell<dim> &cell, const unsigned int v)
    {
      Point<dim> x = cell.lower;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += ((v >> d) & 1) * cell.size;
      return x;
    }
  } // namespace



  // A surface that only grazes a face of the cell leaves a facet of no size
  // that would count at the nodes as others do: such are left out.
  /// All surfaces in cell @p c. The contact point of a facet inside another
  /// obstacle would hold soil where there can be none.
  template <int dim>
  void
  Facets<dim>::cut(const Grid<dim>      &grid,
                   const Obstacles<dim> &obstacles,
                   const unsigned int    c)
  {
    const Cell<dim> &cell   = grid.cells()[c];
    const Point<dim> centre = centre_of(cell);
    const Box<dim>   box    = box_of(cell);
    CutCell          result;
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        const Obstacle<dim> &obstacle = obstacles[k];
        if (!may_cut(obstacle.signed_distance(centre), cell))
          continue;
        const CutSurface<dim> surface =
          surface_in_box<dim>(box, [&](const Point<dim> &x) {
            return obstacle.signed_distance(x);
          });
        if (surface.area < 1e-8 * std::pow(cell.size, dim - 1.))
          continue;
        bool is_hidden = false;
        for (unsigned int other = 0; other < obstacles.size(); ++other)
          is_hidden = is_hidden || (other != k && obstacles[other].signed_distance(
                                                    surface.centroid) < 0);
        if (is_hidden)
          continue;
        Facet<dim> facet;
        facet.cell     = c;
        facet.obstacle = k;
        facet.node     = nodes_of(cell);
        facet.centroid = surface.centroid;
        facet.area     = surface.area;
        facet.normal   = surface.vector_area / surface.vector_area.norm();
        facet.maximum_shear_stress =
          obstacle.maximum_shear_stress(surface.centroid);
        facet.shape_value = shape_values_at(box, surface.centroid);
        result.facets.push_back(facet);
      }
    if (result.facets.empty())
      {
        cut_cells_.erase(c);
        return;
      }
    result.open_volume =
      open_shape_integrals<dim>(box, [&](const Point<dim> &x) {
        return obstacles.signed_distance(x);
      });
    cut_cells_[c] = result;
  }



  template <int dim>
  void
  Facets<dim>::prepare(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    cut_cells_.clear();
    if (!obstacles.empty())
      for (unsigned int c = 0; c < grid.cells().size(); ++c)
        cut(grid, obstacles, c);
    collect(grid, obstacles);
  }



  // Cells that a moving obstacle has left have a facet of it; those that it
  // comes to lie in the box around it. So nothing else needs to be looked at,
  // and the cost follows the obstacle, not the mesh.
  template <int dim>
  void
  Facets<dim>::update(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    std::set<unsigned int> cells;
    for (const auto &[c, cut_cell] : cut_cells_)
      for (const Facet<dim> &facet : cut_cell.facets)
        if (obstacles[facet.obstacle].moves())
          cells.insert(c);
    const double h = grid.finest_size();
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        if (!obstacles[k].moves())
          continue;
        const Box<dim>            around = obstacles[k].bounding_box();
        std::array<long, dim>     n, at{};
        Point<dim>                first;
        for (unsigned int d = 0; d < dim; ++d)
          {
            first[d] = std::max(around.lower[d] - h, grid.domain().lower[d]) +
                       1e-6 * h;
            const double last =
              std::min(around.upper[d] + h, grid.domain().upper[d]);
            n[d] = std::max(0L, std::lround(std::ceil((last - first[d]) / h))) + 1;
          }
        while (at[dim - 1] < n[dim - 1])
          {
            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = first[d] + at[d] * h;
            if (const unsigned int c = grid.find_cell(x);
                c != numbers::invalid_unsigned_int)
              cells.insert(c);
            ++at[0];
            for (unsigned int d = 0; d + 1 < dim && at[d] == n[d]; ++d)
              {
                at[d] = 0;
                ++at[d + 1];
              }
          }
      }
    for (const unsigned int c : cells)
      cut(grid, obstacles, c);
    collect(grid, obstacles);
  }



  /// From the cut cells to lists and sums by node. Ghost cells count for the
  /// nodes that this rank owns, which so need no message.
  template <int dim>
  void
  Facets<dim>::collect(const Grid<dim> &grid, const Obstacles<dim> &obstacles)
  {
    owned_.clear();
    owned_nodes_.clear();
    nodes_.clear();
    nodes_inside_.clear();
    n_facets_.assign(grid.n_nodes(), 0);
    open_volume_.assign(grid.n_nodes(), 0.);
    is_near_.assign(grid.cells().size(), 0);
    if (cut_cells_.empty())
      return;
    for (const auto &[c, cut_cell] : cut_cells_)
      for (const Facet<dim> &facet : cut_cell.facets)
        {
          if (c < grid.n_owned_cells())
            owned_.push_back(facet);
          for (const unsigned int node : facet.node)
            if (n_facets_[node]++ == 0)
              nodes_.push_back(node);
        }
    for (const unsigned int node : nodes_)
      if (node < grid.n_owned_nodes())
        owned_nodes_.push_back(node);
    for (unsigned int c = 0; c < grid.cells().size(); ++c)
      {
        add_open_volume(grid, obstacles, c);
        find_nodes_inside(grid, obstacles, c);
      }
    mark_near_cells(grid);
  }

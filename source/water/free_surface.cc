// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/cut_box.h>
#include <talus/water/free_surface.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    constexpr unsigned int n_corners = power(2, dim);

    /// Where the contour is.
    constexpr double half_filled = 0.5;

    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /// What obstacles leave of a simplex of a cell, whose corners are @p distance
    /// away from them, m, in deal.II's order. What is as good as on a surface
    /// counts as on it, as in surface_in_box().
    template <int dim>
    auto
    open_parts(const Simplex<dim>                    &simplex,
               const Cell<dim>                       &cell,
               const std::array<double, (1u << dim)> &distance)
    {
      std::array<double, dim + 1> depth;
      for (unsigned int v = 0; v <= dim; ++v)
        {
          unsigned int corner = 0;
          for (unsigned int d = 0; d < dim; ++d)
            corner |= (simplex[v][d] > cell.lower[d] + 0.5 * cell.size) << d;
          depth[v] = -distance[corner];
          if (std::abs(depth[v]) < 1e-9 * cell.size)
            depth[v] = 0;
        }
      return clip_simplex<dim>(simplex, depth).parts;
    }
  } // namespace



  // The room of a node and the cells around it: both only for the cells that
  // this rank owns, so that a message completes the room, and each facet is
  // found on one rank.
  template <int dim>
  void
  FreeSurface<dim>::prepare(const Grid<dim> &grid)
  {
    volume_.assign(grid.n_nodes(), 0.);
    std::vector<std::vector<unsigned int>> cells(grid.n_nodes());
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      for (const unsigned int node : grid.cells()[c].nodes())
        {
          volume_[node] += std::pow(grid.cells()[c].size, dim) / n_corners<dim>;
          cells[node].push_back(c);
        }
    for (const auto &hanging : grid.hanging_nodes())
      for (const auto &[master, weight] : hanging.masters)
        volume_[master] += weight * volume_[hanging.node];
    NodalExchange<dim> exchange_of_volumes;
    exchange_of_volumes.prepare(grid, 1);
    exchange_of_volumes.add_to_owners(volume_.data());

    first_cell_.assign(1, 0);
    cells_.clear();
    for (const auto &of_node : cells)
      {
        cells_.insert(cells_.end(), of_node.begin(), of_node.end());
        first_cell_.push_back(cells_.size());
      }
    visited_.assign(grid.n_owned_cells(), 0);
    n_searches_ = 0;
    exchange_.prepare(grid, width);
    records_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    filled_nodes_.clear();
    facets_.clear();
    distance_.assign(grid.n_nodes(), unknown);
  }



  /// How far the corners of a cell are from obstacles, m. Asked for in each step,
  /// by the cells of a node as often as there are: remembered while obstacles
  /// stay where they are.
  template <int dim>
  typename FreeSurface<dim>::ShapeValues
  FreeSurface<dim>::distances(const Cell<dim>      &cell,
                              const Obstacles<dim> &obstacles)
  {
    ShapeValues result;
    for (unsigned int v = 0; v < result.size(); ++v)
      {
        double &known = distance_[cell.nodes()[v]];
        if (std::isnan(known))
          known = obstacles.signed_distance(cell.vertex(v));
        result[v] = known;
      }
    return result;
  }



  /// Volume around an owned node that soil can fill, m^dim.
  template <int dim>
  double
  FreeSurface<dim>::room(const FacetContact<dim> &contact,
                         const unsigned int       node) const
  {
    if (contact.obstacles().empty() || !contact.facets().is_contact_node(node))
      return volume_[node];
    // A corner that an obstacle nearly fills: what boxes overlap of it would
    // count as much as all its room.
    return std::max(contact.facets().open_volume(node), 1e-3 * volume_[node]);
  }



  /// Velocities are those that the points bring along. Round-off must not decide
  /// which cells are looked at where nodes are just half filled, as those at a
  /// level surface in a row of nodes are. Collective.
  template <int dim>
  void
  FreeSurface<dim>::fill_records(const State<dim>        &state,
                                 const FacetContact<dim> &contact)
  {
    for (const unsigned int node : filled_nodes_)
      std::fill_n(record(node), width, 0.);
    filled_nodes_.clear();
    const NodalFields<dim> &nodes = state.nodes;
    for (const unsigned int node : nodes.active_nodes())
      if (nodes.mass(node) > state.mass_cutoff)
        {
          double *const to = record(node);
          to[filling] = std::min(1., nodes.volume(node) / room(contact, node));
          if (std::abs(to[filling] - half_filled) < 1e-12)
            to[filling] = half_filled;
          to[mass]               = nodes.mass(node);
          const Tensor<1, dim> p = nodes.momentum(node);
          for (unsigned int d = 0; d < dim; ++d)
            to[velocity + d] = p[d] / to[mass];
          filled_nodes_.push_back(node);
        }
    exchange_.copy_to_ghosts(records_.data());
    fill_hanging_records(state.grid);
  }



  /// Soil is where the masters have it, and moves as theirs.
  template <int dim>
  void
  FreeSurface<dim>::fill_hanging_records(const Grid<dim> &grid)
  {
    for (const auto &hanging : grid.hanging_nodes())
      {
        double *const to = record(hanging.node);
        std::fill_n(to, width, 0.);
        filled_nodes_.push_back(hanging.node);
        for (const auto &[master, weight] : hanging.masters)
          {
            const double *const from = record(master);
            to[filling] += weight * from[filling];
            to[mass] += weight * from[mass];
            for (unsigned int d = 0; d < dim; ++d)
              to[velocity + d] += weight * from[mass] * from[velocity + d];
          }
        for (unsigned int d = 0; d < dim && to[mass] > 0; ++d)
          to[velocity + d] /= to[mass];
      }
  }



  // Of nodes that are half filled or more, those this rank owns and ghosts, the
  // cells around; so the cost follows the soil, and the order that of the active
  // nodes, which is the same in a resumed run.
  template <int dim>
  void
  FreeSurface<dim>::find(const State<dim>        &state,
                         const FacetContact<dim> &contact)
  {
    fill_records(state, contact);
    facets_.clear();
    if (contact.obstacles().move())
      std::fill(distance_.begin(), distance_.end(), unknown);
    ++n_searches_;
    const Grid<dim> &grid  = state.grid;
    const auto       visit = [&](const unsigned int node) {
      if (fill(node) < half_filled)
        return;
      for (unsigned int i = first_cell_[node]; i < first_cell_[node + 1]; ++i)
        if (const unsigned int c = cells_[i]; visited_[c] != n_searches_)
          {
            visited_[c] = n_searches_;
            cut_cell(grid, contact, c);
          }
    };
    for (const unsigned int node : state.nodes.active_nodes())
      visit(node);
    for (const auto &hanging : grid.hanging_nodes())
      if (hanging.node < grid.n_owned_nodes())
        visit(hanging.node);
    for (unsigned int node = grid.n_owned_nodes(); node < grid.n_nodes();
         ++node)
      visit(node);
  }



  /// Half filled less the degree of filling at the corners of a simplex in a
  /// cell. What is as good as zero is made zero, so that round-off does not show
  /// the cells at a face different signs.
  template <int dim>
  std::array<double, dim + 1>
  FreeSurface<dim>::emptiness_at(const Simplex<dim> &simplex,
                                 const Box<dim>     &box,
                                 const NodesOfCell  &nodes) const
  {
    std::array<double, dim + 1> result;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        const auto N = shape_values_at<dim>(box, simplex[v]);
        result[v]    = half_filled;
        for (unsigned int k = 0; k < N.size(); ++k)
          result[v] -= N[k] * fill(nodes[k]);
        if (std::abs(result[v]) < 1e-12)
          result[v] = 0;
      }
    return result;
  }



  // By simplices, linear in each: the ends of facets at a face are the same
  // seen from both cells, so that nothing is open, and there is none of the
  // ambiguous cases of squares and cubes. In a cell that an obstacle cuts the
  // simplices are cut first.
  template <int dim>
  void
  FreeSurface<dim>::cut_cell(const Grid<dim>         &grid,
                             const FacetContact<dim> &contact,
                             const unsigned int       c)
  {
    const Cell<dim> &cell  = grid.cells()[c];
    const auto       nodes = cell.nodes();
    if (std::none_of(nodes.begin(), nodes.end(), [&](const unsigned int node) {
          return fill(node) < half_filled;
        }))
      return;
    const bool is_near_obstacle =
      !contact.obstacles().empty() &&
      std::any_of(nodes.begin(), nodes.end(), [&](const unsigned int node) {
        return contact.facets().is_contact_node(node);
      });
    const Box<dim> box = cell.box();
    const bool     is_cut =
      is_near_obstacle && contact.facets().nearness_of_cells()[c] == 2;
    ShapeValues distance{};
    if (is_near_obstacle)
      distance = distances(cell, contact.obstacles());
    if (is_near_obstacle && !is_cut &&
        std::accumulate(distance.begin(), distance.end(), 0.) < 0)
      return; // soil is only beside it

    const auto add_facet = [&](const Simplex<dim> &simplex) {
      const Facet<dim> facet =
        clip_simplex<dim>(simplex, emptiness_at(simplex, box, nodes)).facet;
      if (facet.empty())
        return;
      SurfaceFacet<dim> result;
      result.vector_area = vector_area<dim>(facet);
      if (result.vector_area.norm() == 0)
        return;
      result.node     = nodes;
      result.centroid = centroid<dim>(facet);
      set_soil(result, shape_values_at<dim>(box, result.centroid));
      facets_.push_back(result);
    };
    for (const Simplex<dim> &simplex : simplices_of(box))
      if (is_cut)
        for (const Simplex<dim> &part :
             open_parts<dim>(simplex, cell, distance))
          add_facet(part);
      else
        add_facet(simplex);
  }



  // The shares of nodes are by mass as well as by shape functions, as those of a
  // point are: else a node that hardly has soil would get a force that it
  // cannot bear.
  template <int dim>
  void
  FreeSurface<dim>::set_soil(SurfaceFacet<dim> &facet,
                             const ShapeValues &shape_values) const
  {
    double sum = 0;
    for (unsigned int v = 0; v < shape_values.size(); ++v)
      {
        facet.share[v] = shape_values[v] * record(facet.node[v])[mass];
        sum += facet.share[v];
      }
    for (unsigned int v = 0; v < shape_values.size(); ++v)
      {
        facet.share[v] /= sum;
        for (unsigned int d = 0; d < dim; ++d)
          facet.velocity[d] +=
            facet.share[v] * record(facet.node[v])[velocity + d];
      }
  }



  template class FreeSurface<2>;
  template class FreeSurface<3>;
} // namespace talus

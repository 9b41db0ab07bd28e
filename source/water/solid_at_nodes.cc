// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/water/solid_at_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Minimum open volume at a node which touches a facet, as a share of the
    /// volume around the node [-]. With less open volume, the overlap of boxes
    /// with the obstacle would count as much as all soil at the node.
    constexpr double min_open_fraction = 1e-3;

  } // namespace



  // Sums over owned cells only: a message completes the volumes.
  template <int dim>
  void
  SolidAtNodes<dim>::prepare(const Grid<dim> &grid)
  {
    volume_.assign(grid.n_nodes(), 0.);
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      for (const unsigned int node : grid.cells()[c].nodes())
        volume_[node] += std::pow(grid.cells()[c].size, dim) / power(2, dim);
    for (const auto &hanging : grid.hanging_nodes())
      for (const auto &[master, weight] : hanging.masters)
        volume_[master] += weight * volume_[hanging.node];
    NodalExchange<dim> exchange_of_volumes;
    exchange_of_volumes.prepare(grid, 1);
    exchange_of_volumes.add_to_owners(volume_.data());
    records_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    distance_.clear();
    exchange_.prepare(grid, width);
    is_known_ = false;
  }



  template <int dim>
  void
  SolidAtNodes<dim>::update(const Grid<dim> &grid, const Contact<dim> &contact)
  {
    exists_ = !contact.obstacles().empty();
    if (!exists_ || (is_known_ && !contact.obstacles().move()))
      return;
    is_known_ = true;
    find_distances(grid, contact);
    const Facets<dim> &facets = contact.facets();
    std::fill(records_.begin(), records_.end(), 0.);
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (facets.is_contact_node(node))
        records_[width * node + fraction] =
          1. - std::clamp(facets.open_volume(node) / volume_[node],
                          min_open_fraction,
                          1.);
      else if (distance_[node] < 0)
        records_[width * node + fraction] = 1.;
    for (const ContactFacet<dim> &facet : facets.owned())
      for (unsigned int v = 0; v < facet.node.size(); ++v)
        {
          double *const to = &records_[width * facet.node[v]];
          to[area] += facet.area * facet.shape_value[v];
        }
    exchange_.add_to_owners(records_.data());
    exchange_.copy_to_ghosts(records_.data());
  }



  /// Compute the distances of all nodes of cells with a contact node, ghosts
  /// included. A facet at a node of the cell may lie in a neighbor of twice the
  /// size: no vertex is farther from an obstacle than three diameters.
  template <int dim>
  void
  SolidAtNodes<dim>::find_distances(const Grid<dim>    &grid,
                                    const Contact<dim> &contact)
  {
    distance_.assign(grid.n_nodes(), std::numeric_limits<double>::quiet_NaN());
    for (const Cell<dim> &cell : grid.cells())
      {
        const auto nodes = cell.nodes();
        if (std::none_of(nodes.begin(), nodes.end(), [&](unsigned int node) {
              return contact.facets().is_contact_node(node);
            }))
          continue;
        const Obstacles<dim> &obstacles = contact.obstacles();
        const double          reach = 3. * std::sqrt(double(dim)) * cell.size;
        for (unsigned int v = 0; v < nodes.size(); ++v)
          if (double &known = distance_[nodes[v]]; std::isnan(known))
            known =
              obstacles.signed_distance(cell.vertex(v),
                                        obstacles.near(cell.vertex(v), reach));
      }
  }



  template class SolidAtNodes<2>;
  template class SolidAtNodes<3>;
} // namespace talus

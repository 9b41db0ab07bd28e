// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_water_solid_at_nodes_h
#define talus_water_solid_at_nodes_h

#include <talus/contact/contact.h>

#include <vector>

namespace talus
{
  /// Volume fraction and surface area of obstacles around each node. Recomputed
  /// only if the mesh changes or an obstacle moves.
  template <int dim>
  class SolidAtNodes
  {
  public:
    /// Integrate the shape functions. Call after each change of the mesh or its
    /// partition. Collective.
    void
    prepare(const Grid<dim> &grid);

    /// Update volume fractions, areas and distances to the current positions of
    /// the obstacles. Collective.
    void
    update(const Grid<dim> &grid, const Contact<dim> &contact);

    /// Whether the case has obstacles.
    bool
    exists() const
    {
      return exists_;
    }

    /// Integral of the shape function of an owned node outside of all
    /// obstacles, m^dim.
    double
    open_volume(const unsigned int node) const
    {
      return (1. - volume_fraction(node)) * volume_[node];
    }

    /// Volume fraction of obstacles around a node [-]; at most 0.999 at a node
    /// which touches a facet. Zero far from surfaces, also inside an obstacle.
    double
    volume_fraction(const unsigned int node) const
    {
      return exists_ ? records_[width * node + fraction] : 0.;
    }

    /// Area of the facets around a node, weighted by its shape function,
    /// m^(dim-1).
    double
    facet_area(const unsigned int node) const
    {
      return records_[width * node + area];
    }

    /// Whether a node lies inside an obstacle, near its surface.
    bool
    contains(const unsigned int node) const
    {
      return exists_ && distance_[node] < 0;
    }

    /// Signed distance of a node from the obstacles, m; NaN far from surfaces,
    /// where no cell around the node has a contact node.
    double
    distance(const unsigned int node) const
    {
      return distance_[node];
    }

  private:
    // By node: volume fraction [-] and areas of facets, m^(dim-1).
    enum Record
    {
      fraction,
      area,
      width
    };

    void
    find_distances(const Grid<dim> &grid, const Contact<dim> &contact);

    bool                is_known_ = false;
    bool                exists_   = false;
    std::vector<double> volume_;   ///< integral of the shape function, by node
    std::vector<double> records_;  ///< by node
    std::vector<double> distance_; ///< by node, m
    NodalExchange<dim>  exchange_;
  };
} // namespace talus

#endif

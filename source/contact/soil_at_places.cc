// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/soil_at_places.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  SoilAtPlaces<dim>::prepare(const Grid<dim>    &grid,
                             const unsigned char faces,
                             const bool          have_gap)
  {
    faces_ = faces;
    pore_pressure_.prepare(grid);
    at_faces_.prepare(grid, faces);
    face_gaps_.prepare(grid, have_gap ? faces : 0);
    if (obstacles_.empty())
      return;
    prepare_gaps(grid, slots(grid));
    coverage_.prepare(grid);
    fractions_.clear();
  }



  template <int dim>
  void
  SoilAtPlaces<dim>::find(const State<dim> &state)
  {
    at_faces_.find(state);
    face_gaps_.find(state);
    if (state.points.have_pore_pressure())
      pore_pressure_.find(state, nodes_of_places(state.grid));
    if (obstacles_.empty())
      return;
    find_gaps(state);
    find_fractions(facets_.owned(), fractions_);
    find_fractions(facets_.ghosts(), fractions_of_ghosts_);
    coverage_.find(state, fractions_, fractions_of_ghosts_);
  }



  /// Mark the nodes of seabeds and facets, by node, ghosts included, and the
  /// hanging nodes that share their sums with one.
  template <int dim>
  std::vector<unsigned char>
  SoilAtPlaces<dim>::nodes_of_places(const Grid<dim> &grid) const
  {
    std::vector<unsigned char> result(grid.n_nodes(), 0);
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      result[node] = (grid.faces_of_node(node) & faces_) != 0;
    if (!obstacles_.empty())
      for (const auto &at : facets_.nodes_and_obstacles())
        result[at.node] = 1;
    for (const auto &hanging : grid.hanging_nodes())
      for (const auto &[master, weight] : hanging.masters)
        result[hanging.node] |= result[master];
    return result;
  }



  template <int dim>
  void
  SoilAtPlaces<dim>::prepare_gaps(const Grid<dim>          &grid,
                                  std::vector<unsigned int> slots)
  {
    using Plane = typename NodalGaps<dim>::Plane;
    gaps_.prepare(
      grid,
      surfaces(),
      std::move(slots),
      [this](const Point<dim> &x, const double distance) {
        return obstacles_.near(x, distance);
      },
      [this](const unsigned int cell) {
        const ContactFacet<dim> *const facet = facets_.flat_facet(cell);
        return facet ? std::optional<Plane>(
                         {facet->obstacle, facet->centroid, facet->normal})
                     : std::nullopt;
      },
      [this, &grid](const unsigned int cell) {
        const ContactFacet<dim> *const facet = facets_.only_surface(cell);
        return facet ? std::make_pair(tables_.table(grid.cells()[cell], *facet),
                                      facet->obstacle)
                     : std::make_pair<const SurfaceTable<dim> *, unsigned int>(
                         nullptr, 0);
      });
  }



  // Moving obstacles may have come near to others since the last step.
  template <int dim>
  void
  SoilAtPlaces<dim>::find_gaps(const State<dim> &state)
  {
    if (obstacles_.move())
      if (auto slots_now = slots(state.grid); slots_now != gaps_.slots())
        prepare_gaps(state.grid, std::move(slots_now));
    tables_.limit(state.points.size());
    gaps_.find(state,
               facets_.nodes_and_obstacles(),
               facets_.nearness_of_cells(),
               [&](const unsigned int node) {
                 const double room = facets_.open_volume(node);
                 return state.nodes.mass(node) > state.constants.mass_cutoff &&
                            room > 0
                          ? std::min(1., state.nodes.volume(node) / room)
                          : 0.;
               });
  }



  // Distance of a box: distance of the centre less the support of the box.
  template <int dim>
  std::vector<typename NodalGaps<dim>::Surface>
  SoilAtPlaces<dim>::surfaces() const
  {
    std::vector<typename NodalGaps<dim>::Surface> result;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      result.push_back([&obstacle = obstacles_[k]](const Point<dim>     &x,
                                                   const Tensor<1, dim> &half) {
        auto [gap, normal] = obstacle.distance_and_normal(x);
        for (unsigned int d = 0; d < dim; ++d)
          gap -= half[d] * std::abs(normal[d]);
        return gap;
      });
    return result;
  }



  /// Return the slot of each obstacle, the same on all ranks. Obstacles far
  /// apart share a slot: the number of slots follows the density of the
  /// obstacles. Collective.
  template <int dim>
  std::vector<unsigned int>
  SoilAtPlaces<dim>::slots(const Grid<dim> &grid) const
  {
    double largest_cell = 0;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      if (facets_.is_near(c))
        largest_cell = std::max(largest_cell, grid.cells()[c].size);
    const double distance = NodalGaps<dim>::min_distance_in_slot(
      Utilities::MPI::max(largest_cell, grid.communicator()));
    std::vector<unsigned int> result;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      {
        const auto near =
          obstacles_.near(obstacles_[k].bounding_box(), distance);
        std::vector<unsigned char> is_taken(near.size() + 1, 0);
        for (const unsigned int other : near)
          if (other < k && result[other] < is_taken.size())
            is_taken[result[other]] = 1;
        result.push_back(std::find(is_taken.begin(), is_taken.end(), 0) -
                         is_taken.begin());
      }
    return result;
  }



  template <int dim>
  void
  SoilAtPlaces<dim>::find_fractions(
    const std::vector<ContactFacet<dim>> &facets,
    std::vector<double>                  &fractions) const
  {
    fractions.assign(facets.size(), 0.);
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        const ContactFacet<dim> &facet = facets[f];
        double                   sum   = 0;
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          sum += facet.shape_value[v] * volume_fraction(facet.node[v]);
        fractions[f] = sum;
      }
  }



  template class SoilAtPlaces<2>;
  template class SoilAtPlaces<3>;
} // namespace talus

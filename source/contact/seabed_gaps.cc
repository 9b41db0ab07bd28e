// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/seabed_gaps.h>

#include <algorithm>
#include <numeric>

namespace talus
{
  using namespace dealii;

  template <int dim>
  SeabedGaps<dim>::SeabedGaps(Boundaries<dim> &boundaries)
    : boundaries_(boundaries)
  {
    boundaries_.set_gap(
      [this](const unsigned int face, const unsigned int node) {
        return gaps_.room(node, surface_of_face_[face], cell_size_);
      });
  }



  namespace
  {
    /// Surface on face @p face of the box @p domain.
    template <int dim>
    typename NodalGaps<dim>::Surface
    surface_of(const unsigned int face, const Box<dim> &domain)
    {
      const unsigned int axis = face / 2;
      if (face % 2 == 0)
        return [axis, at = domain.lower[axis]](const Point<dim>     &x,
                                               const Tensor<1, dim> &half) {
          return x[axis] - half[axis] - at;
        };
      return [axis, at = domain.upper[axis]](const Point<dim>     &x,
                                             const Tensor<1, dim> &half) {
        return at - x[axis] - half[axis];
      };
    }
  } // namespace



  // In a uniform cell the patch tells which nodes the points may reach; points
  // in all other cells are examined.
  template <int dim>
  void
  SeabedGaps<dim>::prepare(const Grid<dim> &grid)
  {
    if (!boundaries_.has_seabed() || !boundaries_.seabed().has_gap())
      return;
    std::vector<typename NodalGaps<dim>::Surface> surfaces;
    surface_of_face_.assign(2 * dim, 0);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (boundaries_.is_seabed(face))
        {
          surface_of_face_[face] = surfaces.size();
          surfaces.push_back(surface_of(face, grid.domain()));
        }
    // Surfaces are few: each has a slot, and all are near.
    std::vector<unsigned int> numbers(surfaces.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    gaps_.prepare(grid,
                  surfaces,
                  numbers,
                  [numbers](const Point<dim> &, double) { return numbers; });
    cell_size_ = grid.finest_size();
    pairs_.clear();
    std::vector<unsigned char> is_on_seabed(grid.n_nodes(), 0);
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (boundaries_.is_seabed(face) &&
            (grid.faces_of_node(node) & (1u << face)))
          {
            is_on_seabed[node] = 1;
            pairs_.push_back({node, surface_of_face_[face]});
          }
    nearness_.assign(grid.cells().size(), 0);
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell = grid.cells()[c];
        nearness_[c]          = !cell.uniform;
        for (unsigned int k = 0; k < cell.patch.size(); ++k)
          if (cell.patch[k] != numbers::invalid_unsigned_int &&
              is_on_seabed[cell.patch[k]])
            nearness_[c] = std::max<unsigned char>(nearness_[c],
                                                   is_own_node<dim>(k) ? 2 : 1);
      }
  }



  template <int dim>
  void
  SeabedGaps<dim>::find(const State<dim> &state)
  {
    if (!nearness_.empty())
      gaps_.find(state, pairs_, nearness_);
  }



  template class SeabedGaps<2>;
  template class SeabedGaps<3>;
} // namespace talus

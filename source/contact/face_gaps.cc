// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/face_gaps.h>

#include <algorithm>
#include <numeric>

namespace talus
{
  using namespace dealii;

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
  FaceGaps<dim>::prepare(const Grid<dim> &grid, const unsigned char faces)
  {
    faces_ = faces;
    if (faces == 0)
      return;
    std::vector<typename NodalGaps<dim>::Surface> surfaces;
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (faces & (1u << face))
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
    for (unsigned int node = 0; node < grid.n_nodes(); ++node)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (grid.faces_of_node(node) & faces & (1u << face))
          pairs_.push_back({node, surface_of_face_[face]});
    nearness_.assign(grid.cells().size(), 0);
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell = grid.cells()[c];
        nearness_[c]          = !cell.uniform;
        for (unsigned int k = 0; k < cell.patch.size(); ++k)
          if (cell.patch[k] != numbers::invalid_unsigned_int &&
              (grid.faces_of_node(cell.patch[k]) & faces))
            nearness_[c] = std::max<unsigned char>(nearness_[c],
                                                   is_own_node<dim>(k) ? 2 : 1);
      }
  }



  template <int dim>
  void
  FaceGaps<dim>::find(const State<dim> &state)
  {
    if (faces_ != 0)
      gaps_.find(state, pairs_, nearness_);
  }



  template class FaceGaps<2>;
  template class FaceGaps<3>;
} // namespace talus

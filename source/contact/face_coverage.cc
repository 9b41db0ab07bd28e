// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/contact/face_coverage.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/weights.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Number of layers of cells between a cell and a face of the mesh.
    template <int dim>
    unsigned int
    layers_to_face(const Cell<dim>   &cell,
                   const Box<dim>    &domain,
                   const unsigned int face)
    {
      const unsigned int axis = face / 2;
      const double       room =
        (face % 2 == 0 ? cell.lower[axis] - domain.lower[axis]
                       : domain.upper[axis] - cell.lower[axis] - cell.size);
      return std::lround(room / cell.size);
    }
  } // namespace



  // Cells in two layers are listed: boxes in the second layer may reach the
  // first. The row of the patch on the face is 1 - layers at a lower face, 2 +
  // layers at an upper face.
  template <int dim>
  void
  FaceCoverage<dim>::prepare(const Grid<dim> &grid, const unsigned char faces)
  {
    n_faces_ = 0;
    cells_.clear();
    nodes_.clear();
    for (unsigned int face = 0; face < 2 * dim; ++face)
      if (faces & (1u << face))
        slot_[face] = n_faces_++;
    if (n_faces_ == 0)
      return;
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (faces & (1u << face))
          if (const unsigned int layers =
                layers_to_face(grid.cells()[c], grid.domain(), face);
              layers < 2)
            cells_.push_back(
              {c, face, face % 2 == 0 ? 1 - layers : 2 + layers});
    std::vector<unsigned char> hangs(grid.n_nodes(), 0);
    for (const auto &hanging : grid.hanging_nodes())
      hangs[hanging.node] = 1;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if ((faces & (1u << face)) && !hangs[node] &&
            (grid.faces_of_node(node) & (1u << face)))
          nodes_.push_back({node, face, grid.face_share(face, node).volume});
    is_full_.assign(grid.n_nodes(), 0);
    areas_.assign(std::size_t(n_faces_) * grid.n_nodes(), 0.);
    exchange_.prepare(grid, n_faces_);
  }



  template <int dim>
  void
  FaceCoverage<dim>::find(const State<dim> &state)
  {
    if (n_faces_ == 0)
      return;
    for (const auto &[node, face, volume_of_cells] : nodes_)
      {
        area(face, node) = 0.;
        if (state.nodes.volume(node) / volume_of_cells >=
            volume_fraction_of_full_cells)
          is_full_[node] |= 1u << face;
        else
          is_full_[node] &= ~(1u << face);
      }
    // cells_ and segments are both sorted by cell.
    auto at = cells_.begin();
    for (const Segment &segment : state.points.segments())
      {
        while (at != cells_.end() && at->cell < segment.cell)
          ++at;
        for (auto here = at; here != cells_.end() && here->cell == segment.cell;
             ++here)
          if (!is_covered_anyway(state.grid, *here))
            add_cell(state, *here, segment.begin, segment.end);
      }
    give_to_masters(state.grid);
    exchange_.add_to_owners(areas_.data());
  }



  /// Distribute the areas of hanging nodes to their masters.
  template <int dim>
  void
  FaceCoverage<dim>::give_to_masters(const Grid<dim> &grid)
  {
    for (const auto &hanging : grid.hanging_nodes())
      for (unsigned int i = 0; i < n_faces_; ++i)
        {
          double &given = areas_[n_faces_ * hanging.node + i];
          for (const auto &[master, weight] : hanging.masters)
            areas_[n_faces_ * master + i] += weight * given;
          given = 0;
        }
  }



  namespace
  {
    /// Number of nodes in a row of a patch of 4^dim nodes.
    template <int dim>
    constexpr unsigned int nodes_per_row = 1u << (2 * (dim - 1));



    /// Index in the patch of node @p i of the row with index @p row along @p
    /// axis. Two bits of an index count the nodes along each axis.
    unsigned int
    index_in_patch(const unsigned int axis,
                   const unsigned int row,
                   const unsigned int i)
    {
      const unsigned int bits = 2 * axis;
      return (i >> bits << (bits + 2)) | row << bits | (i & ((1u << bits) - 1));
    }
  } // namespace



  /// Whether all nodes in reach of the points of a cell are at full cells,
  /// where the covered area is not needed. Ghost nodes count as not full.
  template <int dim>
  bool
  FaceCoverage<dim>::is_covered_anyway(const Grid<dim>  &grid,
                                       const CellAtFace &at) const
  {
    const Cell<dim> &cell = grid.cells()[at.cell];
    if (!cell.uniform)
      return false;
    for (unsigned int i = 0; i < nodes_per_row<dim>; ++i)
      {
        const unsigned int k = index_in_patch(at.face / 2, at.row, i);
        if (!(is_full_[cell.patch[k]] & (1u << at.face)))
          return false;
      }
    return true;
  }



  namespace
  {
    /// Weight [-] of a box with the lower side @p gap cells above the face.
    double
    weight_of_gap(const double gap)
    {
      constexpr double full = 0.05, none = largest_gap_of_covering_box;
      return std::clamp((none - gap) / (none - full), 0., 1.);
    }
  } // namespace



  namespace
  {
    /// Area of the section of the box of point @p p across @p axis, m^(dim-1);
    /// for a convected domain the mean over its height. @p half: half lengths,
    /// m.
    template <int dim>
    double
    section_of_box(const State<dim>     &state,
                   const unsigned int    p,
                   const unsigned int    axis,
                   const Tensor<1, dim> &half)
    {
      const Points<dim> &points = state.points;
      if (state.constants.box_shape.rule == BoxRule::convected_domain)
        return volume_of_points<dim, double>(points, p) / (2. * half[axis]);
      double area = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        if (d != axis)
          area *= 2. * half[d];
      return area;
    }
  } // namespace



  template <int dim>
  void
  FaceCoverage<dim>::add_cell(const State<dim>  &state,
                              const CellAtFace  &at,
                              const unsigned int begin,
                              const unsigned int end)
  {
    const Cell<dim>   &cell   = state.grid.cells()[at.cell];
    const Box<dim>     domain = state.grid.domain();
    const unsigned int axis   = at.face / 2;
    for (unsigned int p = begin; p < end; ++p)
      {
        const double x = state.points.data(state.points.position, axis)[p];
        const Tensor<1, dim> half = half_lengths_of_box(state.points, p);
        const double         distance =
          (at.face % 2 == 0 ? x - domain.lower[axis] : domain.upper[axis] - x);
        double area = weight_of_gap((distance - half[axis]) / cell.size);
        if (area == 0)
          continue;
        area *= section_of_box(state, p, axis, half);
        if (cell.uniform &&
            state.constants.box_shape.rule != BoxRule::convected_domain)
          add_to_patch(state, at, p, area);
        else
          add_by_weights(state, at, p, area);
      }
  }



  template <int dim>
  void
  FaceCoverage<dim>::add_to_patch(const State<dim>  &state,
                                  const CellAtFace  &at,
                                  const unsigned int p,
                                  const double       area_of_box)
  {
    const Cell<dim>                       &cell = state.grid.cells()[at.cell];
    const unsigned int                     axis = at.face / 2;
    std::array<std::array<double, 4>, dim> share;
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        share[d] = weights_along_axis(
          state.points, state.constants.box_shape, cell, d, p);
    for (unsigned int i = 0; i < nodes_per_row<dim>; ++i)
      {
        const unsigned int k     = index_in_patch(axis, at.row, i);
        double             value = area_of_box;
        for (unsigned int d = 0; d < dim; ++d)
          if (d != axis)
            value *= share[d][(k >> (2 * d)) % 4];
        if (value != 0)
          area(at.face, cell.patch[k]) += value;
      }
  }



  /// Add the area of a box where cells of several sizes meet, or of a convected
  /// domain. The weights of the nodes on the face, divided by their sum, are
  /// the mean shape functions of the box along the face.
  template <int dim>
  void
  FaceCoverage<dim>::add_by_weights(const State<dim>  &state,
                                    const CellAtFace  &at,
                                    const unsigned int p,
                                    const double       area_of_box)
  {
    weights_of_point(state.points,
                     state.grid,
                     state.constants.box_shape,
                     at.cell,
                     p,
                     weights_);
    const auto is_on_face = [&](const NodeWeight<dim> &weight) {
      return state.grid.faces_of_node(weight.node) & (1u << at.face);
    };
    double sum = 0;
    for (const NodeWeight<dim> &weight : weights_)
      if (is_on_face(weight))
        sum += weight.value;
    if (sum > 0)
      for (const NodeWeight<dim> &weight : weights_)
        if (is_on_face(weight))
          area(at.face, weight.node) += weight.value / sum * area_of_box;
  }



  template class FaceCoverage<2>;
  template class FaceCoverage<3>;
} // namespace talus

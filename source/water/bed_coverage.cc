// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/geometry/cut_box.h>
#include <talus/water/bed_coverage.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Volume fractions [-]: from `full` on soil covers the bed, whatever the
    /// boxes cover; linear between `nearly_full` and `full`.
    constexpr double full = 0.7, nearly_full = 0.4;

    /// Height, in cells, of the lower side of a box above the bed: up to
    /// lies_on_bed the box counts, from lies_above_bed on not, linear in
    /// between.
    constexpr double lies_on_bed    = 0.05,
                     lies_above_bed = largest_gap_of_covering_box;

    /// Sum of sections, as a share of the minimum covered area, from which on
    /// the bed counts as covered.
    constexpr double covered = 0.95;

    /// Whether a place is in a cell or on a lower face of the cell.
    template <int dim>
    bool
    contains(const Cell<dim> &cell, const Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (x[d] < cell.lower[d] || x[d] >= cell.lower[d] + cell.size)
          return false;
      return true;
    }

    /// Return the cell which contains @p x, m, often cell @p near or a
    /// neighbour of the cell; nullptr if this rank does not know the cell.
    template <int dim>
    const Cell<dim> *
    cell_around(const Grid<dim>  &grid,
                const Cell<dim>  &near,
                const Point<dim> &x)
    {
      unsigned int number = 0;
      for (unsigned int d = 0; d < dim; ++d)
        number += power(3, d) * (x[d] < near.lower[d]               ? 0
                                 : x[d] < near.lower[d] + near.size ? 1
                                                                    : 2);
      unsigned int c = near.neighbors[number];
      if (c >= grid.cells().size() || !contains(grid.cells()[c], x))
        c = grid.find_cell(x);
      return c < grid.cells().size() ? &grid.cells()[c] : nullptr;
    }

    /// Axis nearest to @p normal: boxes stand on the bed along this axis.
    template <int dim>
    unsigned int
    steepest_axis(const Tensor<1, dim> &normal)
    {
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (std::abs(normal[d]) > std::abs(normal[axis]))
          axis = d;
      return axis;
    }
  } // namespace



  template <int dim>
  void
  BedCoverage<dim>::prepare(const Grid<dim> &grid)
  {
    constexpr unsigned int face = 2;
    is_at_bottom_.assign(grid.n_owned_cells(), 0);
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      is_at_bottom_[c] =
        (grid.faces_of_node(grid.cells()[c].nodes()[0]) >> face) & 1;
    area_of_bottom_.assign(grid.n_owned_nodes(), 0.);
    std::vector<unsigned char> hangs(grid.n_nodes(), 0);
    for (const auto &hanging : grid.hanging_nodes())
      hangs[hanging.node] = 1;
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (!hangs[node] && ((grid.faces_of_node(node) >> face) & 1))
        area_of_bottom_[node] = grid.face_share(face, node).area;
    sums_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    exchange_.prepare(grid, width);
  }



  // Only points in cells at the bed or beside the bed are needed: a box on the
  // bed is at most a cell long.
  template <int dim>
  void
  BedCoverage<dim>::find(const State<dim>        &state,
                         const SolidAtNodes<dim> &solid,
                         const VolumeFraction    &volume_fraction)
  {
    const Grid<dim> &grid = state.grid;
    clear(grid);
    for (const Segment &segment : state.points.segments())
      {
        const Cell<dim> &cell         = grid.cells()[segment.cell];
        const bool       is_at_bottom = is_at_bottom_[segment.cell];
        const bool       is_at_facets =
          solid.exists() && !std::isnan(solid.distance(cell.nodes()[0]));
        if ((!is_at_bottom && !is_at_facets) || is_full(cell, volume_fraction))
          continue;
        if (is_at_bottom)
          for (unsigned int p = segment.begin; p < segment.end; ++p)
            {
              const double y = state.points.data(state.points.position, 1)[p];
              add_box(state,
                      p,
                      cell,
                      {y - cell.lower[1], Point<dim>::unit_vector(1)},
                      bottom);
            }
        if (is_at_facets)
          add_boxes_at_facets(state, segment, solid);
      }
    for (const auto &hanging : grid.hanging_nodes())
      for (const unsigned int i : {bottom, facets})
        {
          double &given = sums_[width * hanging.node + i];
          for (const auto &[master, weight] : hanging.masters)
            if (given > 0)
              {
                sums_[width * master + i] += weight * given;
                touched_.push_back(master);
              }
          given = 0;
        }
    exchange_.add_to_owners(sums_.data());
  }



  /// Reset the sums of the previous step to zero.
  template <int dim>
  void
  BedCoverage<dim>::clear(const Grid<dim> &grid)
  {
    const auto clear_node = [this](const unsigned int node) {
      std::fill_n(sums_.begin() + std::size_t(width) * node, width, 0.);
    };
    std::for_each(touched_.begin(), touched_.end(), clear_node);
    std::for_each(grid.interface_nodes().begin(),
                  grid.interface_nodes().end(),
                  clear_node);
    touched_.clear();
  }



  /// Whether all nodes of a cell are full, so that boxes are not needed.
  template <int dim>
  bool
  BedCoverage<dim>::is_full(const Cell<dim>      &cell,
                            const VolumeFraction &volume_fraction)
  {
    const auto nodes = cell.nodes();
    return std::all_of(nodes.begin(), nodes.end(), [&](const unsigned int n) {
      return volume_fraction(n) >= full;
    });
  }



  /// Add the boxes of @p segment on the facets in and around the cell. The
  /// plane of the bed follows from the distances of the nodes from the
  /// obstacles: one normal per cell. Without a normal no box is added.
  template <int dim>
  void
  BedCoverage<dim>::add_boxes_at_facets(const State<dim>        &state,
                                        const Segment           &segment,
                                        const SolidAtNodes<dim> &solid)
  {
    const Cell<dim>                  &cell  = state.grid.cells()[segment.cell];
    const auto                        nodes = cell.nodes();
    std::array<double, power(2, dim)> distance;
    Plane                             plane{0., Tensor<1, dim>()};
    for (unsigned int v = 0; v < nodes.size(); ++v)
      {
        distance[v] = solid.distance(nodes[v]);
        for (unsigned int d = 0; d < dim; ++d)
          plane.normal[d] += (((v >> d) & 1) ? distance[v] : -distance[v]);
      }
    const double length = plane.normal.norm();
    if (!(length > 0))
      return;
    plane.normal /= length;
    for (unsigned int p = segment.begin; p < segment.end; ++p)
      {
        const auto N = shape_values_at<dim>(
          cell.box(), load_place(state.points, state.points.position, p));
        plane.distance = 0;
        for (unsigned int v = 0; v < nodes.size(); ++v)
          plane.distance += N[v] * distance[v];
        add_box(state, p, cell, plane, facets);
      }
  }



  // The section of a box is sampled at two places per axis of the bed, so that
  // boxes of any length up to a cell cover a flat bed evenly.
  template <int dim>
  void
  BedCoverage<dim>::add_box(const State<dim>  &state,
                            const unsigned int p,
                            const Cell<dim>   &cell,
                            const Plane       &plane,
                            const Sum          sum)
  {
    const Tensor<1, dim> &n    = plane.normal;
    const unsigned int    axis = steepest_axis<dim>(n);
    const Tensor<1, dim>  half = half_lengths_of_box(state.points, p);
    // Most boxes lie above the bed.
    double lowest = plane.distance - half[axis] * std::abs(n[axis]);
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        lowest -= 0.5 * half[d] * std::abs(n[d]);
    if (lowest > (lies_above_bed + 1e-9) * cell.size)
      return;
    double area = 1. / std::abs(n[axis]);
    for (unsigned int d = 0; d < dim; ++d)
      if (d != axis)
        area *= half[d]; // area of a sample; two samples along the axis
    const Point<dim> x = load_place(state.points, state.points.position, p);
    for (unsigned int i = 0; i < power(2, dim - 1); ++i)
      {
        Point<dim> foot     = x;
        double     distance = plane.distance;
        for (unsigned int d = 0, bit = 0; d < dim; ++d)
          if (d != axis)
            {
              const double shift = (((i >> bit++) & 1) ? 0.5 : -0.5) * half[d];
              foot[d] += shift;
              distance += n[d] * shift;
            }
        const double gap =
          (distance - half[axis] * std::abs(n[axis])) / cell.size;
        const double weight =
          std::clamp((lies_above_bed - gap) / (lies_above_bed - lies_on_bed),
                     0.,
                     1.);
        foot[axis] -= distance / n[axis];
        if (weight > 0)
          add_foot(state.grid, cell, foot, weight * area, sum);
      }
  }



  template <int dim>
  void
  BedCoverage<dim>::add_foot(const Grid<dim>  &grid,
                             const Cell<dim>  &near,
                             const Point<dim> &foot,
                             const double      area,
                             const Sum         sum)
  {
    const Cell<dim> *const found = cell_around(grid, near, foot);
    if (found == nullptr)
      return;
    const Cell<dim> &cell  = *found;
    const auto       nodes = cell.nodes();
    Point<dim>       x     = foot;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = std::clamp(x[d], cell.lower[d], cell.lower[d] + cell.size);
    const auto N = shape_values_at<dim>(cell.box(), x);
    for (unsigned int v = 0; v < nodes.size(); ++v)
      {
        double *const sums = &sums_[width * nodes[v]];
        if (sums[bottom] == 0 && sums[facets] == 0)
          touched_.push_back(nodes[v]);
        sums[sum] += N[v] * area;
      }
  }



  /// Return the covered share of the bed at a node [-].
  /// @param sum sections of the boxes, m^(dim-1)
  /// @param area minimum covered area, m^(dim-1)
  /// @param f volume fraction of soil [-]
  template <int dim>
  double
  BedCoverage<dim>::share(const double sum, const double area, const double f)
  {
    if (f == 0)
      return 0.;
    const double by_fraction =
      std::clamp((f - nearly_full) / (full - nearly_full), 0., 1.);
    return std::max(by_fraction, std::min(1., sum / (covered * area)));
  }



  template class BedCoverage<2>;
  template class BedCoverage<3>;
} // namespace talus

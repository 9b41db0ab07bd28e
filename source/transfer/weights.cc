// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/transfer/convected_domain.h>
#include <talus/transfer/weights.h>
#include <talus/transfer/weights_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Box of a point, m, with the inverse of its length along each axis, 1/m.
    template <int dim>
    struct BoxOfPoint
    {
      std::array<double, dim> lower, upper, inverse_length;
      bool                    is_beyond_mesh; ///< partly or wholly
    };



    /// Weights of the two hat functions of one cell, along one axis.
    struct CellShare
    {
      std::array<double, 2> value{};
      std::array<double, 2> gradient{};
    };



    /// Extent of a cell along one axis.
    struct CellExtent
    {
      double lower, upper; ///< m
      double inverse_size; ///< 1/m
      /// Whether the mesh ends at the lower and at the upper face.
      bool at_lower_boundary, at_upper_boundary;
    };



    /// Compute, along one axis, the means over the box [a, b] of the two hat
    /// functions of a cell, as far as the cell covers the box, and of their
    /// derivatives, 1/m. A hat function is linear in the cell, so the mean over
    /// the overlap is the value at its middle: exact. A cell at the boundary of
    /// the mesh is continued outwards with constant shape functions: value 1 of
    /// the boundary node, no gradient.
    inline CellShare
    share_of_cell(const double      a,
                  const double      b,
                  const double      inverse_length,
                  const CellExtent &cell)
    {
      const auto &[lower,
                   upper,
                   inverse_size,
                   at_lower_boundary,
                   at_upper_boundary] = cell;
      const double first              = std::min(std::max(a, lower), upper);
      const double last               = std::min(std::max(b, lower), upper);
      const double inside             = (last - first) * inverse_length;
      const double xi = (0.5 * (first + last) - lower) * inverse_size;

      CellShare share;
      share.value    = {{inside * (1. - xi), inside * xi}};
      share.gradient = {{-inside * inverse_size, inside * inverse_size}};
      if (at_lower_boundary)
        share.value[0] += std::max(0., std::min(b, lower) - a) * inverse_length;
      if (at_upper_boundary)
        share.value[1] += std::max(0., b - std::max(a, upper)) * inverse_length;
      return share;
    }



    /// Add the weights of a box at the 2^dim nodes of one cell: products of the
    /// CellShare along the axes. Adds nothing if cell and box do not overlap.
    /// @param lower corner of the cell or, across a periodic face, of the
    ///   periodic image of the cell, m
    template <int dim>
    void
    add_cell(const Grid<dim>              &grid,
             const Cell<dim>              &cell,
             const Point<dim>             &lower,
             const BoxOfPoint<dim>        &box,
             std::vector<NodeWeight<dim>> &weights)
    {
      // Most cells around a box do not overlap it.
      if (!box.is_beyond_mesh)
        for (unsigned int d = 0; d < dim; ++d)
          if (box.upper[d] <= lower[d] || box.lower[d] >= lower[d] + cell.size)
            return;
      const Box<dim>            &domain       = grid.domain();
      const double               eps          = 1e-9 * cell.size;
      const double               inverse_size = 1. / cell.size;
      std::array<CellShare, dim> share;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double upper = lower[d] + cell.size;
          const bool ends = box.is_beyond_mesh && !grid.periodicity().along(d);
          const CellExtent extent = {lower[d],
                                     upper,
                                     inverse_size,
                                     ends && lower[d] < domain.lower[d] + eps,
                                     ends && upper > domain.upper[d] - eps};
          share[d]                = share_of_cell(box.lower[d],
                                   box.upper[d],
                                   box.inverse_length[d],
                                   extent);
          if (share[d].value[0] == 0 && share[d].value[1] == 0)
            return;
        }
      constexpr unsigned int n_nodes = power(2, dim);
      weights.resize(weights.size() + n_nodes);
      NodeWeight<dim> *const to = &weights.back() + 1 - n_nodes;
#pragma GCC unroll 8
      for (unsigned int v = 0; v < n_nodes; ++v)
        {
          unsigned int at = 0;
          to[v].value     = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            to[v].gradient[d] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const unsigned int i = (v >> d) & 1;
              at += (1 + i) * power(4, d);
              to[v].value *= share[d].value[i];
              for (unsigned int e = 0; e < dim; ++e)
                to[v].gradient[e] *=
                  (d == e ? share[d].gradient[i] : share[d].value[i]);
            }
          to[v].node = cell.patch[at];
        }
    }



    /// Whether the box lies inside @p cell.
    template <int dim>
    bool
    is_inside(const BoxOfPoint<dim> &box, const Cell<dim> &cell)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (box.lower[d] < cell.lower[d] ||
            box.upper[d] > cell.lower[d] + cell.size)
          return false;
      return true;
    }
  } // namespace



  // The definition of doc/method.md, section 1, cell by cell, without using
  // shared nodes: valid for neighbouring cells of different sizes, hanging
  // nodes, walls and periodic faces. In 2-D a point takes about 3000
  // instructions per step, a point in a run 500 (doc/performance.md). Therefore
  // the definition is used only where the kernel for uniform cells
  // (axis_weights()) does not apply, and in the tests of the kernel. A node is
  // listed once for each of its cells; users of the list sum over the entries.
  template <int dim>
  void
  general_weights(const Grid<dim>              &grid,
                  const unsigned int            c,
                  const Point<dim>             &centre,
                  const Tensor<1, dim>         &half,
                  std::vector<NodeWeight<dim>> &weights)
  {
    weights.clear();
    const Cell<dim> &cell = grid.cells()[c];
    BoxOfPoint<dim>  box;
    box.is_beyond_mesh = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.lower[d]          = centre[d] - half[d];
        box.upper[d]          = centre[d] + half[d];
        box.inverse_length[d] = 1. / (box.upper[d] - box.lower[d]);
        box.is_beyond_mesh    = box.is_beyond_mesh ||
                             box.lower[d] < grid.domain().lower[d] ||
                             box.upper[d] > grid.domain().upper[d];
      }
    if (is_inside(box, cell))
      add_cell(grid, cell, cell.lower, box, weights);
    else if (cell.uniform)
      {
        for (unsigned int k = 0; k < cell.neighbors.size(); ++k)
          if (const unsigned int n = cell.neighbors[k];
              n != numbers::invalid_unsigned_int)
            {
              // Computed from the own cell: across a periodic face the box
              // overlaps the periodic image of the neighbour.
              Point<dim> lower = cell.lower;
              for (unsigned int d = 0; d < dim; ++d)
                lower[d] += (k / power(3, d) % 3 - 1.) * cell.size;
              add_cell(grid, grid.cells()[n], lower, box, weights);
            }
      }
    else
      for (const unsigned int n : grid.touching_cells(c))
        {
          const Cell<dim> &touching = grid.cells()[n];
          add_cell(grid, touching, touching.lower, box, weights);
        }
  }



  namespace
  {
    /// Compute the weights of a convected domain corner by corner; a node of
    /// several corners is listed several times. CPDI replaces integrals over a
    /// parallelogram, which crosses cells at any angle, by the mean of an
    /// interpolation between the corners (doc/method.md, section 1). The
    /// interpolation reproduces 1 and x, as the shape functions do, and needs
    /// values at 2^dim positions only.
    template <int dim>
    void
    convected_weights(const Grid<dim>              &grid,
                      const unsigned int            c,
                      const ConvectedDomain<dim>   &domain,
                      std::vector<NodeWeight<dim>> &weights)
    {
      weights.clear();
      for (unsigned int v = 0; v < domain.n_corners; ++v)
        {
          const auto around = nodes_around(grid, c, domain.corner(v));
          const auto factor = domain.gradient_factor(v);
          for (unsigned int n = 0; n < around.node.size(); ++n)
            weights.push_back({around.node[n],
                               around.value[n] / domain.n_corners,
                               around.value[n] * factor});
        }
    }



    /// Compute the weights of a box with half lengths clipped as in the kernel.
    template <int dim>
    void
    weights_of_box(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   const unsigned int            c,
                   const unsigned int            p,
                   std::vector<NodeWeight<dim>> &weights)
    {
      const double   size = grid.cells()[c].size;
      Tensor<1, dim> half;
      for (unsigned int d = 0; d < dim; ++d)
        half[d] =
          size * half_length_in_cells<dim>(points, shape, d, p, 1. / size);
      general_weights(
        grid, c, load_place(points, points.position, p), half, weights);
    }
  } // namespace



  // Conservation of mass and momentum requires weights that sum to one.
  template <int dim>
  void
  weights_of_point(const Points<dim>            &points,
                   const Grid<dim>              &grid,
                   const BoxShape               &shape,
                   const unsigned int            c,
                   const unsigned int            p,
                   std::vector<NodeWeight<dim>> &weights)
  {
    if (shape.rule == BoxRule::convected_domain)
      convected_weights(grid,
                        c,
                        ConvectedDomain<dim>(points, grid, shape, c, p),
                        weights);
    else
      weights_of_box(points, grid, shape, c, p, weights);
    TalusAssert(std::abs(std::accumulate(weights.begin(),
                                         weights.end(),
                                         -1.,
                                         [](const double           sum,
                                            const NodeWeight<dim> &weight) {
                                           return sum + weight.value;
                                         })) < 1e-12,
                ExcMessage("The weights of a point do not sum to one."));
  }



  template decltype(general_weights<2>)  general_weights<2>;
  template decltype(general_weights<3>)  general_weights<3>;
  template decltype(weights_of_point<2>) weights_of_point<2>;
  template decltype(weights_of_point<3>) weights_of_point<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_convected_transfer_h
#define talus_transfer_convected_transfer_h

#include <talus/transfer/convected_domain.h>
#include <talus/transfer/gather_kernel.h>
#include <talus/transfer/scatter_kernel.h>

#include <algorithm>

// Kernels for points with a convected domain, corner by corner, on the rows of
// scatter_kernel.h and gather_kernel.h. The data of a corner are computed once
// for all nodes of the cell around the corner. Registers group over the entries
// of a node. The formulas are those of scatter_by_definition() in reference.h.

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Number of entries of NodalSum up to the total force, rounded up to whole
    /// registers.
    template <int dim>
    inline constexpr unsigned int n_given = 8;
    static_assert(NodalSum<2>::force + 2 <= n_given<2> &&
                  NodalSum<3>::force_by_x == n_given<3>);



    /// Compute the contribution of corner @p v of the domain of point @p k, in
    /// the order of NodalSum, with the total force as one entry per component.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    give_to_corner(const Contributions<dim>   &contributions,
                   const ConvectedDomain<dim> &domain,
                   const double                cell_size,
                   const unsigned int          k,
                   const unsigned int          v,
                   double (&of_corner)[n_given<dim>])
    {
      using Sum = NodalSum<dim>;
      constexpr unsigned int at =
        Sum::force - Contributions<dim>::first_of_force;
      const double *const record = contributions.record[k];
      for (unsigned int e = 0; e < n_given<dim>; ++e)
        of_corner[e] =
          (e < Sum::force_by_x ? record[e] * (1. / domain.n_corners) : 0.);
      // contributions hold the stress divided by the cell size.
      const auto factor = cell_size * domain.gradient_factor(v);
      for (unsigned int i = 0; i < dim; ++i)
        {
          double &force = of_corner[Sum::force + i];
          force += factor[0] * record[Sum::force_by_x + i];
          for (unsigned int d = 1; d < dim; ++d)
            force += factor[d] * contributions.flux[d - 1][k][at + i];
        }
    }



    /// Add the contribution of point @p k of the block to the nodal sums.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    add_corners(const Contributions<dim>   &contributions,
                const ConvectedDomain<dim> &domain,
                const Grid<dim>            &grid,
                const unsigned int          cell,
                const unsigned int          k,
                double                     *sums)
    {
      using Sum                    = NodalSum<dim>;
      constexpr unsigned int width = std::min(simd_width, n_given<dim>);
      using Number                 = Simd<width>;
      alignas(64) double of_corner[n_given<dim>];
      for (unsigned int v = 0; v < domain.n_corners; ++v)
        {
          give_to_corner(
            contributions, domain, grid.cells()[cell].size, k, v, of_corner);
          const auto around = nodes_around(grid, cell, domain.corner(v));
          for (unsigned int n = 0; n < around.node.size(); ++n)
            {
              double *const to =
                sums + Sum::width * std::size_t(around.node[n]);
              for (unsigned int e = 0; e < n_given<dim>; e += width)
                store(to + e,
                      load<Number>(to + e) +
                        Number(around.value[n]) * load<Number>(of_corner + e));
            }
        }
    }



    /// Compute the row of InterpolatedMotion for one point with a convected
    /// domain.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    interpolate_corners(const ConvectedDomain<dim> &domain,
                        const Grid<dim>            &grid,
                        const unsigned int          cell,
                        const double               *motions,
                        double                     *row)
    {
      using Motion                 = NodalMotion<dim>;
      using Row                    = InterpolatedMotion<dim>;
      constexpr unsigned int width = std::min(simd_width, Motion::width);
      using Number                 = Simd<width>;
      std::fill_n(row, Row::n_entries, 0.);
      alignas(64) double at_corner[Motion::width];
      for (unsigned int v = 0; v < domain.n_corners; ++v)
        {
          const auto around = nodes_around(grid, cell, domain.corner(v));
          for (unsigned int e = 0; e < Motion::width; e += width)
            {
              Number sum(0.);
              for (unsigned int n = 0; n < around.node.size(); ++n)
                sum +=
                  Number(around.value[n]) *
                  load<Number>(motions +
                               Motion::width * std::size_t(around.node[n]) + e);
              store(at_corner + e, sum);
            }
          for (unsigned int e = 0; e < Motion::width; ++e)
            row[e] += (1. / domain.n_corners) * at_corner[e];
          const auto factor =
            grid.cells()[cell].size * domain.gradient_factor(v);
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int i = 0; i < dim; ++i)
              row[Row::place_of_gradient(i, d)] += factor[d] * at_corner[i];
        }
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif

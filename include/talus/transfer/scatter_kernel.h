// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_scatter_kernel_h
#define talus_transfer_scatter_kernel_h

#include <talus/grid/nodal_record.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/block.h>
#include <talus/transfer/loads_kernel.h>
#include <talus/transfer/transpose.h>

// Points to grid in registers; scatter_by_definition() in reference.h has the
// formulas.
//
// The weight of a point at a node is a product of factors along the axes, so
// the record of a point (NodalSum) is multiplied axis by axis, z, y, x. The
// force by the gradient along z and y is added on the way. The force by the
// gradient along x has entries of its own, so that along x, where most of the
// work is, each entry takes one multiply-add. Consecutive points with the same
// nodes are summed in registers, nine nodes at a time: memory is accessed once
// for all of them. The record is processed a register at a time, so that nine
// sums and their operands fit into sixteen registers.

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Contributions of the points of a block to the nodal sums. `record` has a
    /// row per point in the order of NodalSum: entries multiplied by the
    /// weight, then entries multiplied by the gradient along x. `flux` has, for
    /// the axes from y on, the force entries multiplied by the gradient along
    /// the axis.
    template <int dim>
    struct Contributions
    {
      using Sum                              = NodalSum<dim>;
      static constexpr unsigned int n_points = Block<dim>::n_points;

      /// First entry of the registers that hold the force, and number of
      /// entries in them.
      static constexpr unsigned int first_of_force =
        Sum::force / simd_width * simd_width;
      static constexpr unsigned int n_of_force =
        (simd_width < 4 ? 4 : simd_width);
      static_assert(Sum::force == 4);
      /// Number of entries in whole registers.
      static constexpr unsigned int n_entries =
        (Sum::n_entries + simd_width - 1) / simd_width * simd_width;

      alignas(64) double record[n_points][n_entries];
      alignas(64) double flux[dim - 1][n_points][n_of_force];
    };



    /// Contributions of one point or of several points side by side, in the
    /// order of Contributions.
    template <int dim, typename Number>
    struct ContributionEntries
    {
      using C                             = Contributions<dim>;
      Number record[C::n_entries]         = {};
      Number flux[dim - 1][C::n_of_force] = {};
    };



    /// Compute mass, momentum, reference volume and force of point(s) @p p,
    /// entry by entry,
    /// f_i = -sum_p V_p sigma_p . grad S_ip + sum_p m_p b_p S_ip. The mean of
    /// the stress is averaged over the cell (B-bar). @cite bardenhagen2004, eq.
    /// 19 ff.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE ContributionEntries<dim, Number>
    compute_contributions(const PointsView<dim, const double> &points,
                          const WorkspaceView<dim>            &workspace,
                          const LoadsView<dim>                &loads,
                          const double       inverse_cell_size,
                          const unsigned int p)
    {
      using Sum = NodalSum<dim>;
      ContributionEntries<dim, Number> entries;
      auto &[record, flux] = entries;
      const auto mass      = load<Number>(points.data(points.mass) + p);
      // Gradients are per cell size.
      const auto volume =
        -inverse_cell_size * volume_of_points<dim, Number>(points, p);
      const auto shift = load<Number>(workspace.mean_stress_shift() + p);

      record[Sum::mass] = mass;
      record[Sum::volume] =
        load<Number>(points.data(points.reference_volume) + p);
      for (unsigned int i = 0; i < dim; ++i)
        {
          record[Sum::momentum + i] =
            mass * load<Number>(points.data(points.velocity, i) + p);
          record[Sum::force + i] = mass * acceleration<Number>(loads, p, i);
        }
      const auto sigma = load_stress<dim, Number>(points, p);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            const Number          &s     = sigma[stress_index<dim>(i, j)];
            const Number           given = volume * (i == j ? s + shift : s);
            constexpr unsigned int at =
              Sum::force - Contributions<dim>::first_of_force;
            const auto add = [&](const unsigned int component,
                                 const unsigned int axis) {
              if (axis == 0)
                record[Sum::force_by_x + component] = given;
              else
                flux[axis - 1][at + component] = given;
            };
            add(i, j);
            add(j, i);
          }
      return entries;
    }



    /// Compute the contributions of all points of the block.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    fill(Contributions<dim>                  &contributions,
         const Block<dim>                    &block,
         const PointsView<dim, const double> &points,
         const WorkspaceView<dim>            &workspace,
         const LoadsView<dim>                &loads)
    {
      using C      = Contributions<dim>;
      using Number = Simd<simd_width>;
      for (unsigned int k = 0; k < block.size; k += simd_width)
        {
          auto entries = compute_contributions<dim, Number>(
            points, workspace, loads, 1. / block.cell_size, block.begin + k);
          const auto to_points =
            [k](auto *rows, auto &to, const unsigned int n) {
              for (unsigned int e = 0; e < n; e += simd_width)
                {
                  transpose(rows + e);
                  for (unsigned int i = 0; i < simd_width; ++i)
                    rows[e + i].store(&to[k + i][e]);
                }
            };
          to_points(entries.record, contributions.record, C::n_entries);
          for (unsigned int d = 0; d < dim - 1; ++d)
            to_points(entries.flux[d], contributions.flux[d], C::n_of_force);
        }
    }



    /// Factors along x for the entries of register @p part: @p value up to the
    /// force, @p gradient from force_by_x on.
    template <int dim, unsigned int part, int... j>
    TALUS_ALWAYS_INLINE Simd<simd_width>
                        factor_along_x(const double value,
                                       const double gradient,
                                       std::integer_sequence<int, j...>)
    {
      using Sum                    = NodalSum<dim>;
      constexpr unsigned int begin = part * simd_width,
                             end   = begin + simd_width;
      if constexpr (end <= Sum::force_by_x)
        return value;
      else if constexpr (begin >= Sum::force_by_x)
        return gradient;
      else
        {
          using Mask                             = SimdMask<simd_width>;
          const typename Mask::Register is_value = {
            (begin + j < Sum::force_by_x ? -1 : 0)...};
          return select(Mask(is_value),
                        Simd<simd_width>(value),
                        Simd<simd_width>(gradient));
        }
    }



    /// Add register @p part of the contributions of the points of a group to
    /// the nodal sums.
    template <int dim, unsigned int part>
    TALUS_ALWAYS_INLINE void
    add_register(const Contributions<dim>                  &contributions,
                 const typename Block<dim>::SameNodesGroup &group,
                 double                                    *sums)
    {
      using C                   = Contributions<dim>;
      using Number              = Simd<simd_width>;
      constexpr unsigned int at = part * simd_width;
      constexpr bool         has_flux =
        (at >= C::first_of_force && at < C::first_of_force + C::n_of_force);
      [[maybe_unused]] constexpr unsigned int in_flux =
        (has_flux ? at - C::first_of_force : 0);
      constexpr auto entries = std::make_integer_sequence<int, simd_width>();

      for (unsigned int plane = 0; plane < (dim == 3 ? 3 : 1); ++plane)
        {
          Number sum[9] = {};
          for_each_bit(group.points, [&](const unsigned int k) {
            Number record = load<Number>(&contributions.record[k][at]);
            Number flux_y;
            if constexpr (has_flux)
              flux_y = load<Number>(&contributions.flux[0][k][in_flux]);
            if constexpr (dim == 3)
              {
                const double z = group.value(dim - 1, plane, k);
                record *= z;
                if constexpr (has_flux)
                  {
                    record +=
                      Number(group.gradient(dim - 1, plane, k)) *
                      load<Number>(&contributions.flux[dim - 2][k][in_flux]);
                    flux_y *= z;
                  }
              }
            Number x[3];
            for (unsigned int i = 0; i < 3; ++i)
              x[i] = factor_along_x<dim, part>(group.value(0, i, k),
                                               group.gradient(0, i, k),
                                               entries);
            for (unsigned int j = 0; j < 3; ++j)
              {
                Number row = Number(group.value(1, j, k)) * record;
                if constexpr (has_flux)
                  row += Number(group.gradient(1, j, k)) * flux_y;
                for (unsigned int i = 0; i < 3; ++i)
                  sum[3 * j + i] += x[i] * row;
              }
          });
          const unsigned int *patch = group.patch + 16 * plane;
          for (unsigned int j = 0; j < 3; ++j)
            for (unsigned int i = 0; i < 3; ++i)
              {
                double *const to =
                  sums + NodalSum<dim>::width * std::size_t(patch[4 * j + i]) +
                  at;
                store(to, load<Number>(to) + sum[3 * j + i]);
              }
        }
    }



    /// Add the contributions of the points of a group to the nodal sums.
    template <int dim, unsigned int part = 0>
    TALUS_ALWAYS_INLINE void
    add_group(const Contributions<dim>                  &contributions,
              const typename Block<dim>::SameNodesGroup &group,
              double                                    *sums)
    {
      if constexpr (part * simd_width < NodalSum<dim>::n_entries)
        {
          add_register<dim, part>(contributions, group, sums);
          add_group<dim, part + 1>(contributions, group, sums);
        }
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_gather_kernel_h
#define talus_transfer_gather_kernel_h

#include <talus/grid/nodal_record.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/block.h>
#include <talus/transfer/loads_kernel.h>
#include <talus/transfer/transpose.h>
#include <talus/transfer/velocity_update_kernel.h>

// Interpolation from grid to points in registers: the loops of scatter_kernel.h
// reversed, first along x, then y, then z. Gradients are computed for the
// velocity only, the first half of a NodalMotion.

namespace talus
{
  inline namespace TALUS_SIMD_NAMESPACE
  {
    /// Motion of the nodes interpolated to the points of a block, a row per
    /// point: velocity and increment in the order of NodalMotion, m/s, then
    /// derivatives of the velocity along each axis, per cell size.
    template <int dim>
    struct InterpolatedMotion
    {
      using Motion                           = NodalMotion<dim>;
      static constexpr unsigned int half     = Motion::width / 2;
      static constexpr unsigned int gradient = Motion::width;
      static constexpr unsigned int n_entries =
        (gradient + half * dim + simd_width - 1) / simd_width * simd_width;

      /// Index of dv_i/dx_d in a row.
      static constexpr unsigned int
      place_of_gradient(const unsigned int i, const unsigned int d)
      {
        return gradient + half * d + i;
      }

      alignas(64) double row[Block<dim>::n_points + n_spare_entries][n_entries];
    };



    /// Interpolated entries of NodalMotion at a point, one register or all.
    template <unsigned int dim, unsigned int width>
    struct MotionAtPoint
    {
      Simd<width> value;
      Simd<width> slope[dim];
    };



    /// Interpolate entries [at, at + width) of the motion of 3^dim nodes to
    /// point @p k of the group, with or without derivatives.
    template <int dim, unsigned int width, bool with_gradient>
    TALUS_ALWAYS_INLINE MotionAtPoint<dim, width>
    interpolate(const typename Block<dim>::SameNodesGroup &group,
                const unsigned int                         k,
                const double *const                       *nodes,
                const unsigned int                         at)
    {
      using Number                = Simd<width>;
      MotionAtPoint<dim, width> p = {};
      for (unsigned int l = 0; l < (dim == 3 ? 3 : 1); ++l)
        {
          Number value(0.), slope_x(0.), slope_y(0.);
          for (unsigned int j = 0; j < 3; ++j)
            {
              Number row(0.), slope(0.);
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const auto node = load<Number>(nodes[9 * l + 3 * j + i] + at);
                  row += Number(group.value(0, i, k)) * node;
                  if constexpr (with_gradient)
                    slope += Number(group.gradient(0, i, k)) * node;
                }
              value += Number(group.value(1, j, k)) * row;
              if constexpr (with_gradient)
                {
                  slope_x += Number(group.value(1, j, k)) * slope;
                  slope_y += Number(group.gradient(1, j, k)) * row;
                }
            }
          if constexpr (dim == 2)
            {
              p.value    = value;
              p.slope[0] = slope_x;
              p.slope[1] = slope_y;
            }
          else
            {
              const Number z(group.value(2, l, k));
              p.value += z * value;
              if constexpr (with_gradient)
                {
                  p.slope[0] += z * slope_x;
                  p.slope[1] += z * slope_y;
                  p.slope[2] += Number(group.gradient(2, l, k)) * value;
                }
            }
        }
      return p;
    }



    /// Interpolate the motion to point @p k of the group and store the row of
    /// the point.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    interpolate(const typename Block<dim>::SameNodesGroup &group,
                const unsigned int                         k,
                const double *const                       *nodes,
                double                                    *row)
    {
      using I                     = InterpolatedMotion<dim>;
      constexpr unsigned int half = I::half;
      if constexpr (simd_width > half)
        {
          // One register holds velocity and increment; only the derivatives of
          // the velocity are kept.
          constexpr unsigned int width = 2 * half;
          const auto p = interpolate<dim, width, true>(group, k, nodes, 0);
          store(row, p.value);
          store(row + I::gradient, first_halves(p.slope[0], p.slope[1]));
          if constexpr (dim == 3)
            store(row + I::gradient + width,
                  first_halves(p.slope[2], Simd<width>(0.)));
        }
      else
        for (unsigned int at = 0; at < half; at += simd_width)
          {
            const auto v =
              interpolate<dim, simd_width, true>(group, k, nodes, at);
            store(row + at, v.value);
            for (unsigned int d = 0; d < dim; ++d)
              store(row + I::gradient + half * d + at, v.slope[d]);
            const auto dv =
              interpolate<dim, simd_width, false>(group, k, nodes, half + at);
            store(row + half + at, dv.value);
          }
    }



    /// Compute the addresses of the nodes at which the points of a group have
    /// weights.
    template <int dim>
    TALUS_ALWAYS_INLINE void
    find_nodes(const typename Block<dim>::SameNodesGroup &group,
               const double                              *motions,
               const double                             **nodes)
    {
      for (unsigned int l = 0; l < (dim == 3 ? 3 : 1); ++l)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int i = 0; i < 3; ++i)
            nodes[9 * l + 3 * j + i] =
              motions + NodalMotion<dim>::width *
                          std::size_t(group.patch[16 * l + 4 * j + i]);
    }



    /// Rows of simd_width points (or one point), transposed: a register per
    /// entry.
    template <int dim, typename Number>
    struct MotionEntries
    {
      using I = InterpolatedMotion<dim>;
      Number entry[I::n_entries];

      TALUS_ALWAYS_INLINE explicit MotionEntries(
        const double (*row)[I::n_entries])
      {
        if constexpr (std::is_same_v<Number, Simd<simd_width>>)
          for (unsigned int e = 0; e < I::n_entries; e += simd_width)
            {
              for (unsigned int i = 0; i < simd_width; ++i)
                entry[e + i] = load<Number>(&row[i][e]);
              transpose(entry + e);
            }
        else
          for (unsigned int e = 0; e < I::n_entries; ++e)
            // The caller has set all entries of each row.
            // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage)
            entry[e] = row[0][e];
      }
    };



    /// Data of a step for the update of points of one body in cells of equal
    /// size.
    template <int dim>
    struct PointUpdate
    {
      PointsView<dim>    points;
      WorkspaceView<dim> workspace; ///< receives the velocity gradients, 1/s
      LoadsView<dim>     loads;
      VelocityUpdate     velocity_update;
      double             inverse_cell_size; ///< 1/m
      double             dt;                ///< time step, s
    };



    /// Move point(s) @p p: v_p by VelocityUpdate, x_p <- x_p + dt v(x_p).
    ///
    /// @param now interpolated motion of the nodes at the point(s)
    /// @return power of the loads on the point(s), m b . (mean velocity), W
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE Number
    move_points(const PointUpdate<dim>           &update,
                const unsigned int                p,
                const MotionEntries<dim, Number> &now)
    {
      using I            = InterpolatedMotion<dim>;
      const auto &points = update.points;
      Number      power(0.);
      for (unsigned int i = 0; i < dim; ++i)
        {
          const Number v    = now.entry[NodalMotion<dim>::velocity + i];
          const Number dv   = now.entry[NodalMotion<dim>::increment + i];
          double      *to_v = points.data(points.velocity, i) + p;
          double      *to_x = points.data(points.position, i) + p;
          store(to_v, update.velocity_update(load<Number>(to_v), v, dv));
          store(to_x, load<Number>(to_x) + update.dt * v);
          for (unsigned int d = 0; d < dim; ++d)
            store(update.workspace.velocity_gradient(i, d) + p,
                  update.inverse_cell_size *
                    now.entry[I::place_of_gradient(i, d)]);
          power += acceleration<Number>(update.loads, p, i) * (v - 0.5 * dv);
        }
      return power * load<Number>(points.data(points.mass) + p);
    }



    /// Whether point(s) @p p are in the cell whose lower corner is @p lower.
    /// False if a coordinate is NaN.
    template <int dim, typename Number, typename Columns>
    TALUS_ALWAYS_INLINE auto
    is_inside(const Columns     &points,
              const unsigned int p,
              const Number      *lower,
              const double       cell_size)
    {
      auto inside = (lower[0] == lower[0]);
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto x = load<Number>(points.data(points.position, d) + p);
          inside &= (x >= lower[d]) & (x < lower[d] + cell_size);
        }
      return inside;
    }
  } // namespace TALUS_SIMD_NAMESPACE
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_points_view_h
#define talus_points_points_view_h

#include <talus/base/small_matrix.h>

#include <cstddef>

namespace talus
{
  /// Entries behind the last point of every column, so that whole registers may
  /// be loaded and stored there.
  constexpr unsigned int n_spare_entries = 8;



  /// Columns of every point: index of the first scalar array of each column.
  /// Tensors are stored row by row. The order is: columns read by both sweeps
  /// of a step, columns read by the second sweep, columns read rarely.
  template <int dim>
  struct PointColumns
  {
    static constexpr unsigned int position = 0; ///< dim, m
    static constexpr unsigned int velocity =
      dim; ///< dim, m/s, at the half step
    /// dim*dim, m: column k of this tensor A is edge k of the point's cell.
    static constexpr unsigned int edges = velocity + dim;
    static constexpr unsigned int stress =
      edges + dim * dim; ///< Cauchy, n_stress_components, Pa
    static constexpr unsigned int mass =
      stress + n_stress_components<dim>;                       ///< 1, kg
    static constexpr unsigned int reference_volume = mass + 1; ///< 1, m^dim
    static constexpr unsigned int box_length =
      reference_volume + 1; ///< dim, m, along the axes
    static constexpr unsigned int elastic_energy = box_length + dim;   ///< 1, J
    static constexpr unsigned int plastic_work   = elastic_energy + 1; ///< 1, J
    static constexpr unsigned int length_at_creation =
      plastic_work + 1; ///< dim, m, of each edge when the point was made
    static constexpr unsigned int generation =
      length_at_creation + dim; ///< 1, number of splits in its history
    static constexpr unsigned int initial_position = generation + 1; ///< dim, m
    static constexpr unsigned int id   = initial_position + dim; ///< 1, unique
    static constexpr unsigned int body = id + 1; ///< 1, index of the body
    static constexpr unsigned int n_arrays = body + 1;
  };



  /// Access to the columns of points, for functions of one point. Trivially
  /// copyable and independent of the container. Laws know the indices of their
  /// additional columns.
  template <int dim, typename Value = double>
  struct PointsView : PointColumns<dim>
  {
    Value      *memory;
    std::size_t pitch; ///< doubles from one array to the next

    Value *
    data(const unsigned int column, const unsigned int component = 0) const
    {
      return memory + (column + component) * pitch;
    }
  };



  /// Access to a StepWorkspace for functions of one point. Row r of point p is
  /// row(r)[p].
  template <int dim>
  struct WorkspaceView
  {
    double      *memory;
    std::size_t  pitch;
    unsigned int begin; ///< first point of the range

    double *
    row(const unsigned int r) const
    {
      return memory + r * pitch - begin;
    }

    /// Velocity gradient dv_i/dx_j, 1/s; set by the gather.
    double *
    velocity_gradient(const unsigned int i, const unsigned int j) const
    {
      return row(dim * i + j);
    }

    /// Shift of the mean stress by B-bar, Pa.
    double *
    mean_stress_shift() const
    {
      return row(dim * dim);
    }
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_nodal_record_h
#define talus_grid_nodal_record_h

// Memory layout of the nodal records, for NodalFields and the kernels of
// transfer/. All other code uses the functions of NodalFields.

namespace talus
{
  /// Sums of the contributions of points to a node, in whole registers, so that
  /// few multiply-adds add all contributions of a point.
  ///
  /// The force has two parts. The contribution of a point is a product of
  /// factors along the axes. The factor along x is the weight for all entries
  /// but the internal force by the gradient along x, whose factor is the
  /// gradient; it therefore has separate entries.
  template <int dim>
  struct NodalSum
  {
    static constexpr unsigned int mass     = 0; ///< kg
    static constexpr unsigned int momentum = 1; ///< kg m/s
    /// Force without the part by the gradient along x, N.
    static constexpr unsigned int force = 4;
    /// Volume of the soil at reference density, m^dim.
    static constexpr unsigned int volume = (dim == 2 ? 3 : 7);
    /// Part of the force by the gradient along x, N.
    static constexpr unsigned int force_by_x = force + (dim == 2 ? 2 : 4);
    /// Number of used entries, a multiple of four.
    static constexpr unsigned int n_entries = (dim == 2 ? 8 : 12);
    /// Number of doubles per node: whole cache lines.
    static constexpr unsigned int width = (dim == 2 ? 8 : 16);
  };



  /// Motion of a node: new velocity, and its increment in the step.
  template <int dim>
  struct NodalMotion
  {
    static constexpr unsigned int velocity  = 0;                  ///< m/s
    static constexpr unsigned int increment = (dim == 2 ? 2 : 4); ///< m/s
    static constexpr unsigned int width     = 2 * increment;
  };
} // namespace talus

#endif

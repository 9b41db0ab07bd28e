// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_nodal_record_h
#define talus_grid_nodal_record_h

// How the numbers of a node lie in memory: the business of NodalFields and of
// the kernels in transfer/. Everybody else asks NodalFields.

namespace talus
{
  /// What the points send to a node: whole registers, so that few multiply-adds
  /// give a node a point's share of everything.
  ///
  /// The force has two parts. What a point gives to a node is a product of
  /// factors along the axes; the factor along x is the weight for all entries
  /// but those of the part of the internal force that comes with the gradient
  /// along x, which takes that gradient instead, and so has entries of its own.
  template <int dim>
  struct NodalSum
  {
    static constexpr unsigned int mass     = 0; ///< kg
    static constexpr unsigned int momentum = 1; ///< kg m/s
    /// The force but for the part by the gradient along x, N.
    static constexpr unsigned int force = 4;
    /// Volume of the soil in its reference density, m^dim.
    static constexpr unsigned int volume = (dim == 2 ? 3 : 7);
    /// Part of the force by the gradient along x, N.
    static constexpr unsigned int force_by_x = force + (dim == 2 ? 2 : 4);
    /// Entries with a meaning, a multiple of four.
    static constexpr unsigned int n_entries = (dim == 2 ? 8 : 12);
    /// Entries from a node to the next: whole lines of the cache.
    static constexpr unsigned int width = (dim == 2 ? 8 : 16);
  };



  /// What a node sends back: new velocity and its increment.
  template <int dim>
  struct NodalMotion
  {
    static constexpr unsigned int velocity  = 0;                  ///< m/s
    static constexpr unsigned int increment = (dim == 2 ? 2 : 4); ///< m/s
    static constexpr unsigned int width     = 2 * increment;
  };
} // namespace talus

#endif

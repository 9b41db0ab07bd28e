// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_velocity_update_kernel_h
#define talus_transfer_velocity_update_kernel_h

#include <talus/base/always_inline.h>

namespace talus
{
  /// Update of the velocities of the points in a step. FLIP adds the increment
  /// of the grid to the velocity of the point, PIC takes the velocity of the
  /// grid. @cite brackbill1986
  struct VelocityUpdate
  {
    double flip_fraction; ///< weight of FLIP [-]; PIC has the remainder

    /// Return the new velocity, m/s.
    /// @param own Velocity of the point(s) before the update, m/s.
    /// @param velocity Velocity of the grid at the point(s), m/s.
    /// @param increment Change of the velocity of the grid in the step, m/s.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    operator()(const Number &own,
               const Number &velocity,
               const Number &increment) const
    {
      return flip_fraction * (own + increment) +
             (1. - flip_fraction) * velocity;
    }
  };

  /// Update by PIC alone: the points take the velocity of the grid.
  inline constexpr VelocityUpdate pic = {0.};
} // namespace talus

#endif

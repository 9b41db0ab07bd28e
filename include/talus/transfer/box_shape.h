// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_shape_h
#define talus_transfer_box_shape_h

namespace talus
{
  /// How the box of a point follows its deformation. Its length along axis d is
  /// stretch_d times the reference length. A box stays parallel to the axes
  /// (GIMP), but for the convected domain, whose edge d is that axis of the
  /// undeformed box as F turns and stretches it.
  enum class BoxRule
  {
    fixed,                ///< box keeps its reference length (uniform GIMP)
    deformation_gradient, ///< F_dd: blind to shear, vanishes at 90 degrees
    right_stretch,        ///< U_dd of F = R U, in the axes of the start
    left_stretch,         ///< V_dd of F = V R (default)
    convected_domain      ///< |F e_d|, parallelogram of edges F e_d (CPDI)
  };

  /// The box of a point as the weights see it. @cite bardenhagen2004
  struct BoxShape
  {
    BoxRule rule = BoxRule::left_stretch;
    /// Half of the length is clipped to these, in units of the own cell: the
    /// lower one keeps the step stable, the upper one keeps the box within the
    /// touching cells.
    double least_half = 0.1;
    double most_half  = 0.5;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_shape_h
#define talus_transfer_box_shape_h

namespace talus
{
  /// How the box of a point follows its deformation. The length along axis d is
  /// stretch_d times the reference length. All boxes but the convected domain
  /// stay parallel to the axes (GIMP); the edges of the convected domain are
  /// F e_d, the axes of the undeformed box turned and stretched by F.
  enum class BoxRule
  {
    fixed,                ///< box keeps its reference length (uniform GIMP)
    deformation_gradient, ///< F_dd: blind to shear, vanishes at 90 degrees
    right_stretch,        ///< U_dd of F = R U, in the initial axes
    left_stretch,         ///< V_dd of F = V R (default)
    convected_domain      ///< |F e_d|, parallelogram of edges F e_d (CPDI)
  };

  /// Shape of the boxes for the weights. @cite bardenhagen2004
  struct BoxShape
  {
    BoxRule rule = BoxRule::left_stretch;
    /// Limits of the half length of a box in sizes of its cell [-]. The lower
    /// limit keeps the step stable, the upper limit keeps the box within the
    /// touching cells.
    double min_half = 0.1;
    double max_half = 0.5;
  };
} // namespace talus

#endif

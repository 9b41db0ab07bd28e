// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_box_shape_h
#define talus_transfer_box_shape_h

namespace talus
{
  /// How the box of a point follows the edges of its cell, which are the
  /// columns of the tensor A. All boxes but the convected domain stay parallel
  /// to the axes (GIMP).
  enum class BoxRule
  {
    fixed,        ///< box keeps its lengths (uniform GIMP)
    left_stretch, ///< V_dd of F = V R: counts shear as stretch, for @cite esub
    second_moments,  ///< second moments of the cell (default)
    convected_domain ///< the cell itself (CPDI)
  };

  /// Shape of the boxes for the weights. @cite bardenhagen2004
  struct BoxShape
  {
    BoxRule rule = BoxRule::second_moments;
    /// Whether shear lengthens edges without end. Otherwise long edges are
    /// replaced by shorter edges of the same lattice, see reduce_edges().
    bool counts_shear = false;
    /// Lower limit of the half length of a box in sizes of its cell [-], which
    /// keeps the step stable.
    double min_half = 0.1;
    /// Upper limit, which keeps the box within the touching cells [-].
    static constexpr double max_half = 0.5;
  };
} // namespace talus

#endif

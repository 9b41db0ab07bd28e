// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_edge_reduction_h
#define talus_transfer_edge_reduction_h

#include <talus/points/points.h>

namespace talus
{
  /// Replace long edges of the points [begin, end) by shorter edges of the same
  /// lattice (Lagrange-Gauss reduction; in 3-D towards a basis that is reduced
  /// in the sense of Minkowski). @cite nguyen2009
  ///
  /// The cell of a point has the edges a_k = L_k F e_k, m. Equal cells side by
  /// side tile the soil as a lattice, and cells with the edges a_k - m v tile
  /// the same lattice for any integer m, if v is another edge, or in 3-D the
  /// sum or difference of both other edges. Volume and tiling stay unchanged.
  /// Simple shear lengthens edges without end, although the lattice keeps short
  /// ones; molecular dynamics changes the basis of a sheared periodic cell in
  /// the same way. @cite lees1972 @cite kraynik1992
  ///
  /// The replacement acts on the columns of F. Afterwards F maps reference
  /// lengths to edges, and is no deformation gradient. Call only for laws whose
  /// stress is not a function of F.
  ///
  /// @param counts_shear if true, only edges with a stretch beyond 1000 are
  ///   replaced: the determinant of F would lose its digits.
  template <int dim>
  void
  reduce_edges(Points<dim> &points,
               unsigned int begin,
               unsigned int end,
               bool         counts_shear);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_edge_reduction_h
#define talus_transfer_edge_reduction_h

#include <talus/points/points.h>
#include <talus/transfer/film.h>

#include <functional>
#include <optional>

namespace talus
{
  /// Replace long edges of the points [begin, end) by shorter edges of the same
  /// lattice (Lagrange-Gauss reduction; in 3-D towards a basis that is reduced
  /// in the sense of Minkowski). @cite nguyen2009
  ///
  /// Equal cells side by side, with the edges a_k, tile the soil as a lattice.
  /// Cells with the edges a_k - m v tile the same lattice for any integer m, if
  /// v is another edge, or in 3-D the sum or difference of both other edges.
  /// Volume and tiling stay unchanged. Simple shear lengthens edges without
  /// end, although the lattice keeps short ones; molecular dynamics changes the
  /// basis of a sheared periodic cell in the same way.
  /// @cite lees1972 @cite kraynik1992
  ///
  /// @param counts_shear if true, only edges 1000 times as long as at creation
  ///   are replaced: the determinant, the volume, would lose its digits.
  /// @param film_at the film in which a point lies, if it does: there an edge
  ///   is shortened only to where half of the film or more has neighbours.
  ///   Empty: no point does.
  template <int dim>
  void
  reduce_edges(
    Points<dim>                                                 &points,
    unsigned int                                                 begin,
    unsigned int                                                 end,
    bool                                                         counts_shear,
    const std::function<std::optional<Film<dim>>(unsigned int)> &film_at = {});
} // namespace talus

#endif

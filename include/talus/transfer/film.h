// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_film_h
#define talus_transfer_film_h

#include <talus/grid/nodal_fields.h>
#include <talus/points/points.h>

namespace talus
{
  /// Plate with the second moments of soil.
  template <int dim>
  struct Film
  {
    dealii::Tensor<1, dim> normal;    ///< unit vector across
    double                 thickness; ///< m
  };

  /// Return the plate that the cells of the sorted points [begin, end) form:
  /// normal to the direction in which they spread least about their centre. A
  /// film of n points one above the other is n points thick.
  template <int dim>
  Film<dim>
  film_of(const Points<dim> &points, unsigned int begin, unsigned int end);

  /// Return whether the soil in a cell and around it is a film, thinner than
  /// 1.1 times the cell. The volumes of soil must be known at the nodes of the
  /// cell, see NodalFields::share_volumes() and sum_volumes().
  template <int dim>
  bool
  is_film(const Cell<dim> &cell, const NodalFields<dim> &nodes);

  /// Set the volumes at the nodes: each cell distributes the reference volume
  /// of its points in equal shares to its nodes. All other sums at the nodes
  /// become zero. Collective.
  template <int dim>
  void
  sum_volumes(const Points<dim> &points,
              const Grid<dim>   &grid,
              NodalFields<dim>  &nodes);
} // namespace talus

#endif

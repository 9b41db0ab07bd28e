// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_obstacle_remarks_h
#define talus_contact_obstacle_remarks_h

#include <talus/base/remark.h>
#include <talus/contact/obstacles.h>
#include <talus/grid/grid.h>

#include <string>
#include <vector>

namespace talus
{
  /// Compare the extents of @p obstacles along the axes with the smallest cells
  /// that the mesh may have there. Throw ExcUser if an obstacle is shorter than
  /// a cell along two axes (a small ball, a thin pipe): the same nodes lie on
  /// all sides, so that soil meets a body as large as a cell. Return a sentence
  /// for the log for each obstacle shorter than two cells along an axis.
  template <int dim>
  std::vector<Remark>
  check_obstacle_sizes(const Obstacles<dim> &obstacles, const Grid<dim> &grid);



  /// Return a remark for each finite obstacle at rest with no part in the
  /// region @p domain of the mesh outside of all other obstacles.
  template <int dim>
  std::vector<Remark>
  notes_on_hidden_obstacles(const Obstacles<dim> &obstacles,
                            const Box<dim>       &domain);

  /// Return a remark for each infinite obstacle (a bed) with friction but
  /// without maximum shear stress. Call if soil has an undrained shear
  /// strength.
  template <int dim>
  std::vector<Remark>
  notes_on_uncapped_beds(const Obstacles<dim> &obstacles);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_body_thickness_h
#define talus_problem_body_thickness_h

#include <talus/base/remark.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/problem/body.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Maximum vertical thickness of the soil of all bodies in the columns of
  /// cells of one body, without the parts removed by obstacles: a thin body
  /// shears with the soil above and below.
  struct BodyThickness
  {
    std::string body;
    double      cell_size; ///< smallest cells in the body, m
    double      n_cells;   ///< across the thickness [-]
  };

  /// Return the thickness of each body, from the volumes of the points above
  /// the cells of the plan. Collective.
  template <int dim>
  std::vector<BodyThickness>
  measure_thickness(const Points<dim>                             &points,
                    const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                    const Grid<dim>                               &grid);

  /// Return a sentence with the thickness of the thinnest soil in cells; empty
  /// without bodies.
  std::string
  sentence_on_thinnest(const std::vector<BodyThickness> &bodies);

  /// Return a remark for each body in soil thinner than two cells: information
  /// for one to two cells of soil that @p slides on its base.
  std::vector<Remark>
  notes_on_thickness(const std::vector<BodyThickness> &bodies, bool slides);
} // namespace talus

#endif

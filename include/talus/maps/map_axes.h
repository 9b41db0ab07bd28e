// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_axes_h
#define talus_maps_map_axes_h

#include <talus/base/raster.h>
#include <talus/maps/map_settings.h>
#include <talus/maps/plan_columns.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <array>

namespace talus
{
  /// Axes of the columns of a map, x and in 3-D z.
  template <int dim>
  using MapAxes = std::array<typename LatticeColumns<dim>::Axis, dim - 1>;



  /// Return the axes of columns that cover the mesh before growth. In 3-D their
  /// faces coincide with cell faces of the raster of the maps, if there is one.
  /// Throw ExcUser if the raster does not exist, or if the maps have too many
  /// cells.
  template <int dim>
  MapAxes<dim>
  map_axes(const Problem<dim> &problem,
           const State<dim>   &state,
           const MapSettings  &settings);



  /// Return the raster of the cells of @p axes, without values. Rows have the
  /// order of the columns: z points south, and the first row of a raster is the
  /// northernmost row.
  /// @param origin map coordinates of the origin of the mesh, m
  Raster
  map_frame(const MapAxes<3> &axes, const dealii::Point<3> &origin);
} // namespace talus

#endif

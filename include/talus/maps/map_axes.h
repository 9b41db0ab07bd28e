// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_map_axes_h
#define talus_maps_map_axes_h

#include <talus/base/raster.h>
#include <talus/maps/plan_columns.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <array>
#include <string>

namespace talus
{
  /// Axes of the columns of a map, x and in 3-D z.
  template <int dim>
  using MapAxes = std::array<typename LatticeColumns<dim>::Axis, dim - 1>;



  /// Return the axes of columns that cover the mesh before growth. In 3-D their
  /// faces coincide with cell faces of the raster of the surface @p surface, if
  /// there is one.
  /// @param cell_size width of the columns, m; 0: width of the cells of the
  /// raster or, without a raster, of the mesh
  template <int dim>
  MapAxes<dim>
  map_axes(const Problem<dim> &problem,
           const State<dim>   &state,
           const std::string  &surface,
           double              cell_size);



  /// Return the raster of the cells of @p axes, without values. Rows have the
  /// order of the columns: z points south, and the first row of a raster is the
  /// northernmost row.
  /// @param origin map coordinates of the origin of the mesh, m
  Raster
  map_frame(const MapAxes<3> &axes, const dealii::Point<3> &origin);
} // namespace talus

#endif

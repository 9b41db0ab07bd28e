// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/map_axes.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  MapAxes<dim>
  map_axes(const Problem<dim> &problem,
           const State<dim>   &state,
           const std::string  &surface,
           const double        cell_size)
  {
    const Box<dim> domain = state.grid.domain_before_growth();
    const Raster  *raster = nullptr;
    MapAxes<dim>   axes;
    if (dim == 3)
      raster = problem.surfaces().raster(surface);
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        const unsigned int d    = axis_of_plan<dim>(a);
        auto              &axis = axes[a];
        axis.lower              = domain.lower[d];
        axis.size               = state.grid.cell_size();
        if (raster != nullptr)
          {
            const Point<3> &origin = problem.origin();
            axis.size              = (a == 0 ? raster->dx : raster->dy);
            axis.lower =
              a == 0 ? raster->west - origin[0] : origin[1] - raster->north();
          }
        if (cell_size > 0)
          axis.size = cell_size;
        // Round-off must not add a column.
        axis.lower +=
          axis.size *
          std::floor((domain.lower[d] - axis.lower) / axis.size + 1e-9);
        const double n = (domain.upper[d] - axis.lower) / axis.size;
        axis.number =
          static_cast<unsigned int>(std::clamp(std::ceil(n - 1e-9), 1., 1e9));
      }
    return axes;
  }



  Raster
  map_frame(const MapAxes<3> &axes, const Point<3> &origin)
  {
    Raster raster;
    raster.n_columns = axes[0].number;
    raster.n_rows    = axes[1].number;
    raster.dx        = axes[0].size;
    raster.dy        = axes[1].size;
    raster.west      = origin[0] + axes[0].lower;
    raster.south     = origin[1] - axes[1].lower - raster.n_rows * raster.dy;
    return raster;
  }



  template decltype(map_axes<2>) map_axes<2>;
  template decltype(map_axes<3>) map_axes<3>;
} // namespace talus

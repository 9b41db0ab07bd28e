// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
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
           const MapSettings  &settings)
  {
    const std::string &name = settings.raster();
    AssertThrow(name.empty() || problem.surfaces().raster(name) != nullptr,
                ExcUser(text("'Maps/Raster' is '",
                             name,
                             "', which is no surface with a raster. Use a "
                             "surface of 'Surfaces/Names' with a `File`.")));
    const Box<dim> domain = state.grid.domain_before_growth();
    const Raster  *raster = nullptr;
    MapAxes<dim>   axes;
    AssertThrow(settings.cell_size() <= domain.length(0),
                ExcUser(text("'Maps/Cell size' is ",
                             settings.cell_size(),
                             " m, more than the ",
                             domain.length(0),
                             " m of the mesh. Make it smaller.")));
    double n_cells = 1;
    if (dim == 3)
      raster = problem.surfaces().raster(name);
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
        if (settings.cell_size() > 0)
          axis.size = settings.cell_size();
        // Round-off must not add a column.
        axis.lower +=
          axis.size *
          std::floor((domain.lower[d] - axis.lower) / axis.size + 1e-9);
        const double n = (domain.upper[d] - axis.lower) / axis.size;
        axis.number =
          static_cast<unsigned int>(std::clamp(std::ceil(n - 1e-9), 1., 1e9));
        n_cells *= axis.number;
      }
    AssertThrow(n_cells <= 1e8,
                ExcUser(text("The maps would have ",
                             n_cells,
                             " cells. Make 'Maps/Cell size' larger.")));
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

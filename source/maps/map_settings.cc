// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/maps/map_settings.h>

#include <set>

namespace talus
{
  using namespace dealii;

  MapSettings::MapSettings()
    : ParameterAcceptor("/Maps")
  {
    add_parameter("Write",
                  is_enabled_,
                  "Write maps of the largest thickness, speed, momentum flux "
                  "and shear stress of the bed in all steps, with their times, "
                  "of the times of arrival, and of the final thickness and the "
                  "erosion: in 3-D rasters (Esri ASCII grids in the folder "
                  "maps) and maps.vtu, in 2-D maps.csv.");
    add_parameter("Write GeoTIFF",
                  writes_geotiff_,
                  "3-D only: write each of these rasters as GeoTIFF, too, with "
                  "the coordinate system of the raster whose cells they have. "
                  "Needs a talus that was built with GDAL.");
    add_parameter("Raster",
                  raster_,
                  "3-D only: name of the surface whose raster gives the maps "
                  "their cells and their place. Empty: the first one that has "
                  "a raster; without any, cells of the mesh's size.");
    add_parameter("Cell size",
                  cell_size_,
                  "Of the maps [m]. 0: that of the raster; without one, and in "
                  "2-D, that of the mesh.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Arrival thresholds",
                  arrival_thresholds_,
                  "Thicknesses whose first time is mapped [m], separated by "
                  "commas. Empty: 'Smallest thickness'.",
                  this->prm,
                  Patterns::List(Patterns::Double(1e-12)));
    add_parameter("Smallest thickness",
                  smallest_thickness_,
                  "Where soil is thinner, speed, flux and shear stress do not "
                  "count [m]: else the last drops, which fly ahead, would give "
                  "the largest ones. 0: a tenth of 'Grid/Cell size'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Steps between samples",
                  steps_between_samples_,
                  "1: look at every step, so that no maximum is missed; more "
                  "is cheaper.",
                  this->prm,
                  Patterns::Integer(1));
  }



  void
  MapSettings::check(const double height) const
  {
    const auto check_thickness = [height](const std::string &entry,
                                          const double       thickness) {
      AssertThrow(thickness <= height,
                  ExcUser(text("'Maps/",
                               entry,
                               "' is ",
                               thickness,
                               " m, which soil in a mesh ",
                               height,
                               " m high cannot reach. Make it smaller.")));
    };
    check_thickness("Smallest thickness", smallest_thickness_);
    std::set<double> known;
    for (const double threshold : arrival_thresholds_)
      {
        check_thickness("Arrival thresholds", threshold);
        AssertThrow(known.insert(threshold).second,
                    ExcUser(text("'Maps/Arrival thresholds' lists ",
                                 threshold,
                                 " m twice. Remove one.")));
      }
  }



  std::vector<double>
  MapSettings::arrival_thresholds(const double h) const
  {
    return arrival_thresholds_.empty()
             ? std::vector<double>(1, smallest_thickness(h))
             : arrival_thresholds_;
  }
} // namespace talus

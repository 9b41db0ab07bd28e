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
                  "Write maps: the maximum over all steps of thickness, speed, "
                  "momentum flux and bed shear stress, with the times of the "
                  "maxima; arrival times; final thickness and erosion. In 3-D "
                  "rasters (Esri ASCII grids in the folder maps) and maps.vtu, "
                  "in 2-D maps.csv.");
    add_parameter("Write GeoTIFF",
                  writes_geotiff_,
                  "3-D only: write each raster of the maps as GeoTIFF, too, "
                  "with the coordinate system of the raster that defines the "
                  "cells.");
    add_parameter("Raster",
                  raster_,
                  "3-D only: name of the surface whose raster defines the "
                  "cells of the maps. Empty: the first surface with a raster; "
                  "without any raster, cells of 'Grid/Cell size'.");
    add_parameter("Cell size",
                  cell_size_,
                  "Cell size of the maps [m]. 0: cell size of the raster; "
                  "without a raster, and in 2-D, 'Grid/Cell size'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Arrival thresholds",
                  arrival_thresholds_,
                  "Thicknesses for which arrival times are mapped [m], "
                  "separated by commas. Empty: 'Smallest thickness'.",
                  this->prm,
                  Patterns::List(Patterns::Double(1e-12)));
    add_parameter("Smallest thickness",
                  smallest_thickness_,
                  "Thickness of soil below which speed, flux and shear stress "
                  "do not count [m]: thin soil flying ahead would give the "
                  "largest values. 0: a tenth of 'Grid/Cell size'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Motion between samples",
                  motion_between_samples_,
                  "Distance that the fastest point moves between two samples, "
                  "over the cell size of the maps [-]. 0: sample every step.",
                  this->prm,
                  Patterns::Double(0., 1.));
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

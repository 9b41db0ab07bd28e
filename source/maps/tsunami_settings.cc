// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/surface_motion.h>
#include <talus/maps/tsunami_settings.h>

namespace talus
{
  using namespace dealii;

  TsunamiSettings::TsunamiSettings()
    : ParameterAcceptor("/Tsunami source")
  {
    add_parameter(
      "Write",
      is_enabled_,
      "Write the change of the height of the sea floor in time as "
      "the source of a tsunami model: tsunami-source.tt3 (GeoClaw's "
      "dtopo, type 3) and tsunami-source.csv.");
    add_parameter("Write netCDF",
                  writes_netcdf_,
                  "Write the same numbers as tsunami-source.nc, too.");
    add_parameter("Coordinates",
                  coordinates_,
                  "Coordinates of the source: those of the 'map', m, or "
                  "'degrees', longitude and latitude in WGS 84. Degrees need "
                  "a 3-D mesh on a raster with a coordinate system.",
                  this->prm,
                  Patterns::Selection("map|degrees"));
    add_parameter("Interval",
                  interval_,
                  "Time between two blocks of the source [s]. A fifth of the "
                  "time in which the wave crosses the water depth d, "
                  "sqrt(d/g), is short enough.",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Start time",
                  start_time_,
                  "Time of the tsunami run at which the slide starts [s]. "
                  "Must be later than the start of the tsunami run, where a "
                  "motion would be taken for initial topography. 0: "
                  "'Interval'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Cell size",
                  cell_size_,
                  "Cell size of the source [m]. 0: cells of the maps.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Width",
                  width_,
                  "2-D only: width of the slide across the section [m], by "
                  "which the section is extruded.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Water depth",
                  water_depth_,
                  "Depth of the water d above the slide [m], for the column "
                  "of the speed over sqrt(g d). 0: no such column.",
                  this->prm,
                  Patterns::Double(0.));
  }



  void
  TsunamiSettings::check(const unsigned int dim) const
  {
    AssertThrow(
      (dim == 2) == (width_ > 0),
      ExcUser(dim == 2 ? "'Tsunami source/Width' is 0, where the width of the "
                         "slide across the 2-D section, m, was expected. Set "
                         "the width."
                       : text("'Tsunami source/Width' is ",
                              width_,
                              " m, but a 3-D slide has a width of its own. "
                              "Remove the entry.")));
    AssertThrow(dim == 3 || !is_in_degrees(),
                ExcUser("'Tsunami source/Coordinates' is degrees, but a 2-D "
                        "section has no place on a map. Use map, or a 3-D "
                        "mesh."));
    if (writes_netcdf_)
      check_netcdf();
  }
} // namespace talus

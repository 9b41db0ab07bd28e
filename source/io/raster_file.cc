// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/base/shell.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/esri_grid.h>
#include <talus/io/gdal_raster.h>
#include <talus/io/length_unit.h>
#include <talus/io/raster_file.h>
#include <talus/io/text_file.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace talus
{
  using namespace dealii;

  namespace
  {
    void
    check_readable(const std::filesystem::path &file)
    {
      // Devices and pipes are refused: content can be read only once, or has no
      // end, and opening a pipe waits for a writer.
      std::error_code error;
      AssertThrow(std::filesystem::is_regular_file(file, error) &&
                    std::ifstream(file).peek() != EOF,
                  ExcUser("The raster '" + file.string() +
                          "' cannot be read or is empty. Give the path of an "
                          "existing file, from the folder of the parameter "
                          "file."));
    }



    /// Return the unit of the heights, m: of the values or of the vertical
    /// axis, which is removed from the coordinate system. Return 1 for another
    /// quantity.
    double
    unit_of_heights(const std::filesystem::path &file, Raster &raster)
    {
      const double axis = strip_vertical_axis(raster.coordinate_system);
      if (!raster.has_heights)
        return 1.;
      const double stated = length_of_unit(raster.unit);
      const auto   check  = [&file](const bool success, const auto &...words) {
        AssertThrow(success,
                    ExcUser(
                      text("The raster '", file.string(), "' has ", words...)));
      };
      check(axis >= 0.,
            "a vertical axis that points down, where heights were expected. "
            "Turn the sign: gdal_calc.py -A IN --calc=-A --outfile=OUT.tif.");
      check(raster.unit.empty() || stated > 0.,
            "heights in '",
            raster.unit,
            "', where metres, feet, US survey feet, or fathoms were expected. "
            "Convert the heights, or correct the unit: gdal_edit.py -units m "
            "FILE.");
      check(axis == 0. || stated == 0. || std::abs(axis / stated - 1.) < 1e-9,
            "heights in '",
            raster.unit,
            "', but a vertical axis with a unit of ",
            axis,
            " m. Correct one of the two: gdal_edit.py -units UNIT FILE.");
      return stated > 0. ? stated : axis > 0. ? axis : 1.;
    }



    /// Return whether a number of the file, in units of @p unit, m, marks cells
    /// without a datum, though the file does not declare the mark, and would be
    /// taken for a datum: a customary mark, or a height that no place has. The
    /// deepest place of the Earth has -10 935 m.
    bool
    is_mark(const double number, const double unit, const bool is_height)
    {
      for (const double customary : {-9999., 9999., 32767., 99999.})
        if (number == customary)
          return true;
      return is_height ? number * unit < -12e3 || number * unit > 1e6
                       : std::abs(number) > 1e30;
    }



    /// Refuse implausible numbers. Squares of coordinates must not overflow.
    void
    check_magnitudes(const std::filesystem::path &file,
                     const Raster                &raster,
                     const double                 unit)
    {
      const auto [lowest, highest] = range_of(raster.values);
      AssertThrow(lowest <= highest,
                  ExcUser("The raster '" + file.string() +
                          "' has no value at the mesh. Give another raster, or "
                          "move the mesh ('Grid/Origin', 'Section')."));
      for (const double mark : {lowest, highest})
        AssertThrow(!is_mark(mark, unit, raster.has_heights),
                    ExcUser(
                      text("The raster '",
                           file.string(),
                           raster.has_heights ? "' has heights from "
                                              : "' has numbers from ",
                           lowest * unit,
                           " to ",
                           highest * unit,
                           raster.has_heights ? " m: is " : ": is ",
                           shortest(mark),
                           " a value for no data that the raster does "
                           "not declare? Declare the value: nodata_value ",
                           shortest(mark),
                           " in the head of an Esri ASCII grid, or "
                           "gdal_edit.py -a_nodata ",
                           shortest(mark),
                           ' ',
                           for_shell(file.string()),
                           ".")));
      const double farthest = std::max({std::abs(raster.west),
                                        std::abs(raster.south),
                                        raster.n_columns * raster.dx,
                                        raster.n_rows * raster.dy});
      AssertThrow(farthest <= 1e9,
                  ExcUser(text("The raster '",
                               file.string(),
                               "' reaches to ",
                               farthest,
                               " m, where a map of the Earth in metres was "
                               "expected. Correct its head.")));
    }
  } // namespace



  Raster
  systems_beside(std::filesystem::path file)
  {
    Raster     result;
    const auto words         = read_text_file(file.replace_extension(".prj"));
    result.coordinate_system = Utilities::trim(words.value_or(""));
    check_understood(result.coordinate_system,
                     "The file '" + file.string() + "'");
    // A line of old files: Zunits FEET.
    std::istringstream in(boost::to_lower_copy(result.coordinate_system));
    for (std::string word, unit; in >> word;)
      if (word == "zunits" && in >> unit && unit != "no")
        result.unit = unit;
    return result;
  }



  Raster
  read_raster(const std::filesystem::path &file,
              const RasterPart            &part,
              const bool                   has_heights)
  {
    check_readable(file);
    const RasterPart placed = [&](Raster whole) {
      if (whole.coordinate_system.empty())
        {
          const Raster beside     = systems_beside(file);
          whole.coordinate_system = beside.coordinate_system;
          if (whole.unit.empty())
            whole.unit = beside.unit;
        }
      return part(whole);
    };
    Raster raster      = read_gdal_raster(file, placed);
    raster.has_heights = has_heights;
    const double unit  = unit_of_heights(file, raster);
    check_magnitudes(file, raster, unit);
    if (unit != 1.)
      for (double &height : raster.values)
        height *= unit;
    raster.unit.clear();
    return raster;
  }



  void
  check_in_metres(const std::filesystem::path &file, const Raster &raster)
  {
    const MapUnit unit = map_unit(raster.coordinate_system);
    if (unit == MapUnit::metres || unit == MapUnit::unknown)
      return;
    AssertThrow(false,
                ExcUser(
                  text("The raster '",
                       file.string(),
                       unit == MapUnit::other ? "' is not in metres"
                                              : "' is in degrees",
                       ": its cells are ",
                       raster.dx,
                       " wide, and it reaches from ",
                       raster.west,
                       " to ",
                       raster.east(),
                       ". A map in metres was expected. Set `Projection` = ",
                       utm_zone(raster.middle(), raster.coordinate_system),
                       ", or project the raster yourself by gdalwarp.")));
  }
} // namespace talus

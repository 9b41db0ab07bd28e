// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/terrain.h>
#include <talus/io/files.h>
#include <talus/io/map_projection.h>
#include <talus/io/raster_file.h>
#include <talus/terrain/named_surface.h>
#include <talus/terrain/project_raster.h>

#include <deal.II/base/utilities.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>

namespace talus
{
  using namespace dealii;

  template <int dim>
  NamedSurface<dim>::NamedSurface(const std::string &name)
    : ParameterAcceptor("/Surfaces/" + name)
    , name_(name)
  {
    add_parameter("File",
                  file_,
                  "Raster of heights, from the folder of this file: an Esri "
                  "ASCII grid, netCDF-4 (GEBCO, GMT) or, if talus was built "
                  "with GDAL, GeoTIFF; in metres, or in degrees with a "
                  "`Projection`. In 3-D x is the easting and -z "
                  "the northing, from 'Grid/Origin' on.");
    add_parameter("Projection",
                  projection_,
                  "Of a raster in degrees (WGS 84): the map in metres that it "
                  "is brought to on reading, and that 'Grid/Origin' and "
                  "`Section` are on: zone and hemisphere as UTM 33N or UTM "
                  "33S, or EPSG:3575, a number of PROJ's database. Empty: the "
                  "raster is in metres.");
    add_parameter("Cell size",
                  cell_size_,
                  "Of the raster on that map [m]; 0: the smaller side that its "
                  "cells have in its middle.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Units",
      units_,
      "Of the raster's coordinates: 'guess', by what the file says "
      "and by their size, so that maps in degrees are refused without "
      "a `Projection`; 'm', for flumes, which may look like degrees.",
      this->prm,
      Patterns::Selection("guess|m"));
    add_parameter("Section",
                  section_,
                  "2-D only: corners of the line on the map that the surface "
                  "is cut along, as easting,northing; easting,northing; ... "
                  "[m]. x is the length along it, and it goes on straight "
                  "beyond both ends.");
    add_parameter("Expression",
                  expression_,
                  "In place of a file: the height as an expression in x (, z) "
                  "and the surfaces listed before this one [m].");
  }



  namespace
  {
    /// Throw ExcUser if the line through @p corners in the plan turns back or
    /// meets itself: then two places x of the section lie at one of the map.
    void
    check_section(const std::string &path, const std::vector<Point<2>> &corners)
    {
      using Corner = boost::geometry::model::d2::point_xy<double>;
      boost::geometry::model::linestring<Corner> line;
      for (std::size_t i = 0; i < corners.size(); ++i)
        {
          line.emplace_back(corners[i][0], corners[i][1]);
          AssertThrow(i < 2 || (corners[i] - corners[i - 1]) *
                                   (corners[i - 1] - corners[i - 2]) >=
                                 0.,
                      ExcUser(text(path,
                                   " turns back at its corner ",
                                   i,
                                   ", (",
                                   corners[i - 1],
                                   ") m, by more than 90 degrees, where a line "
                                   "that goes on was expected. Correct the "
                                   "corners or their order.")));
        }
      AssertThrow(boost::geometry::is_simple(line),
                  ExcUser(text(path,
                               " crosses or touches itself, where a line that "
                               "goes on was expected. Correct the corners or "
                               "their order.")));
    }
  } // namespace



  template <int dim>
  std::vector<Point<2>>
  NamedSurface<dim>::section() const
  {
    std::vector<Point<2>> corners;
    for (const auto &corner : Utilities::split_string_list(section_, ';'))
      {
        const auto numbers = Utilities::split_string_list(corner, ',');
        // Squares of larger ones would overflow.
        const Patterns::Double number(-1e9, 1e9);
        AssertThrow(
          numbers.size() == 2 && number.match(numbers[0]) &&
            number.match(numbers[1]),
          ExcUser(text(path("Section"),
                       " contains '",
                       corner,
                       "', where two numbers 'easting,northing' of "
                       "at most 1e9 m were expected; corners are separated by "
                       "semicolons.")));
        const Point<2> x(Utilities::string_to_double(numbers[0]),
                         Utilities::string_to_double(numbers[1]));
        AssertThrow(corners.empty() || x.distance(corners.back()) > 0.,
                    ExcUser(text(path("Section"),
                                 " lists '",
                                 corner,
                                 "' twice in a row. Remove one.")));
        corners.push_back(x);
      }
    AssertThrow(dim == 3 || corners.size() >= 2,
                ExcUser(text(path("Section"),
                             " = '",
                             section_,
                             "' is no line on the map, but in 2-D the raster '",
                             file_,
                             "' is cut along one. Give two corners or more, as "
                             "easting,northing; easting,northing.")));
    if (dim == 2)
      check_section(path("Section"), corners);
    return corners;
  }



  /// Projected, if it is in degrees.
  template <int dim>
  Raster
  NamedSurface<dim>::read_file(const std::filesystem::path &file) const
  {
    AssertThrow(projection_.empty() || units_ != "m",
                ExcUser(text(path("Projection"),
                             " is '",
                             projection_,
                             "', which is for rasters in degrees, but ",
                             path("Units"),
                             " is 'm'. Remove one of the two entries.")));
    AssertThrow(!projection_.empty() || cell_size_ == 0.,
                ExcUser(text(path("Cell size"),
                             " is ",
                             cell_size_,
                             " m, but the cells of a raster change only where "
                             "there is a `Projection`. Remove the entry.")));
    // Without PROJ the reader says how to project it by hand.
    const bool is_projected =
      !projection_.empty() && MapProjection::is_available();
    protect_input(file);
    Raster raster = read_raster(file,
                                units_ == "m"  ? RasterUnits::metres
                                : is_projected ? RasterUnits::degrees
                                               : RasterUnits::guess);
    AssertThrow(raster.n_columns >= 2 && raster.n_rows >= 2,
                ExcUser(text("The raster '",
                             file_,
                             "' has ",
                             raster.n_rows,
                             " rows and ",
                             raster.n_columns,
                             " columns, but a surface needs two of both.")));
    if (projection_.empty())
      return raster;
    const MapProjection map(path("Projection"), projection_);
    raster                   = project_raster(std::move(raster),
                            map,
                            cell_size_,
                            path("Projection") + " = " + projection_);
    raster.coordinate_system = map.coordinate_system();
    return raster;
  }



  template <int dim>
  std::shared_ptr<const Surface<dim>>
  NamedSurface<dim>::read(const std::filesystem::path &folder,
                          const Point<3>              &origin) const
  {
    AssertThrow(file_.empty() != expression_.empty(),
                ExcUser(
                  text("The section Surfaces/",
                       name_,
                       " has ",
                       file_.empty() ? "neither `File` nor" : "both `File` and",
                       " `Expression`. Give one of the two.")));
    const auto corners = section();
    Raster     raster  = read_file(file(folder));
    return std::make_shared<Terrain<dim>>(std::make_shared<const HeightField>(
                                            std::move(raster)),
                                          file_,
                                          origin,
                                          corners);
  }



  template class NamedSurface<2>;
  template class NamedSurface<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/terrain.h>
#include <talus/io/files.h>
#include <talus/io/raster_file.h>
#include <talus/terrain/named_surface.h>

#include <deal.II/base/utilities.h>

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
                  "ASCII grid or netCDF-4 (GEBCO, GMT), in metres. In 3-D x is "
                  "the easting and -z the northing, from 'Grid/Origin' on.");
    add_parameter(
      "Units",
      units_,
      "Of the raster's coordinates: 'guess', by what the file says "
      "and by their size, so that maps in degrees are refused; 'm', "
      "for flumes, which may look like degrees.",
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
    return corners;
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
    protect_input(folder / file_);
    Raster raster =
      read_raster(folder / file_,
                  units_ == "m" ? RasterUnits::metres : RasterUnits::guess);
    AssertThrow(raster.n_columns >= 2 && raster.n_rows >= 2,
                ExcUser(text("The raster '",
                             file_,
                             "' has ",
                             raster.n_rows,
                             " rows and ",
                             raster.n_columns,
                             " columns, but a surface needs two of both.")));
    return std::make_shared<Terrain<dim>>(std::make_shared<const HeightField>(
                                            std::move(raster)),
                                          file_,
                                          origin,
                                          corners);
  }



  template class NamedSurface<2>;
  template class NamedSurface<3>;
} // namespace talus

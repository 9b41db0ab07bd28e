// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/corner_list.h>
#include <talus/geometry/outline_surface.h>
#include <talus/geometry/terrain.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/files.h>
#include <talus/io/map_outline.h>
#include <talus/io/raster_file.h>
#include <talus/terrain/bring_to_map.h>
#include <talus/terrain/named_surface.h>
#include <talus/terrain/plan_place.h>
#include <talus/terrain/project_raster.h>

#include <deal.II/base/utilities.h>

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>

#include <cmath>

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
                  "Raster of heights, from the folder of this file, in any "
                  "format that GDAL reads (GeoTIFF, Esri ASCII grid, netCDF as "
                  "GEBCO and GMT write it); in metres, or with a `Projection`. "
                  "In 3-D x is the easting and -z the northing, from "
                  "'Grid/Origin' on. Or the polygons of any file of vectors "
                  "(GeoJSON, shapefile, GeoPackage, KML), as an `Outline`.");
    add_parameter("Attribute",
                  attribute_,
                  "Name of a number of each polygon of `File`, such as its "
                  "depth: the surface has the number of the nearest polygon "
                  "in place of the distance from the outline.");
    add_parameter("Quantity",
                  quantity_,
                  "'height': `File` has heights, converted to metres and, in "
                  "the mesh, counted from the height of 'Grid/Origin'. "
                  "'other': a shear strength, a thickness, a ratio, for "
                  "expressions such as `Undrained shear strength`; the numbers "
                  "stay as they are, in the unit of the file: strengths and "
                  "stresses in Pa.",
                  this->prm,
                  Patterns::Selection("height|other"));
    add_parameter("Projection",
                  projection_,
                  "Map in metres to which the file is projected on reading, "
                  "and which is the map of 'Grid/Origin' and `Section`: zone "
                  "and hemisphere as UTM 33N or UTM 33S, or a code of the "
                  "EPSG registry as EPSG:3575. A file without a coordinate "
                  "system is then taken to be in degrees (WGS 84). "
                  "Empty: the file is in metres.");
    add_parameter("Cell size",
                  cell_size_,
                  "Cell size of the projected raster on the map of "
                  "`Projection` [m]; 0: the shorter side of the cell in the "
                  "middle of the raster, measured on the map.",
                  this->prm,
                  Patterns::Double(0.));
    add_plan_parameters();
  }



  template <int dim>
  void
  NamedSurface<dim>::add_plan_parameters()
  {
    add_parameter(
      "Section",
      section_,
      "2-D only: corners of the line on the map along which the "
      "raster or the outline is cut, as easting,northing; easting,northing; "
      "... [m]. x is the length along the line, which extends "
      "straight beyond both ends.");
    add_parameter("Expression",
                  expression_,
                  "In place of a file: the height as an expression in x (, "
                  "z) and the surfaces listed before this surface [m].");
    add_parameter(
      "Outline",
      outline_,
      "In place of a file: corners 'x, z; x, z; ...' of an area "
      "in plan [m]; in 2-D on the map. The surface is as high as the place is "
      "distant from the outline [m], above zero inside and below "
      "zero outside: for expressions such as the slip surface "
      "'mudline - min(15, max(0, outline))' of a release area "
      "15 m deep, with sides of 45 degrees.");
    add_parameter("Coordinates",
                  coordinates_,
                  "'map': the corners of the outline are easting, northing.",
                  this->prm,
                  Patterns::Selection("mesh|map"));
  }



  namespace
  {
    /// Throw ExcUser if the line through @p corners in plan turns back or meets
    /// itself: two places x of the section would lie at one place of the map.
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
    const auto corners = parse_corners(path("Section"), section_);
    for (std::size_t i = 1; i < corners.size(); ++i)
      AssertThrow(corners[i] != corners[i - 1],
                  ExcUser(text(path("Section"),
                               " lists '",
                               corners[i],
                               "' twice in a row. Remove one.")));
    AssertThrow(dim == 3 || corners.size() >= 2,
                ExcUser(
                  text(path("Section"),
                       " = '",
                       section_,
                       "' is no line on the map, but in 2-D the ",
                       file_.empty() ? "outline" : text("raster '", file_, "'"),
                       " is cut along one. Give two corners or more, as "
                       "easting,northing; easting,northing.")));
    if (dim == 2)
      check_section(path("Section"), corners);
    return corners;
  }



  template <int dim>
  std::string
  NamedSurface<dim>::map() const
  {
    return projection_.empty() ? "" : map_code(path("Projection"), projection_);
  }



  /// Read the raster around @p plan on the map, and project the raster if there
  /// is a map.
  template <int dim>
  Raster
  NamedSurface<dim>::read_file(const std::filesystem::path &file,
                               const Box<2>                &plan) const
  {
    AssertThrow(!projection_.empty() || cell_size_ == 0.,
                ExcUser(text(path("Cell size"),
                             " is ",
                             cell_size_,
                             " m, but the cells of a raster change only where "
                             "there is a `Projection`. Remove the entry.")));
    const std::string map = this->map();
    protect_input(file);
    Raster raster = read_raster(
      file,
      [&](const Raster &whole) {
        AssertThrow(whole.n_columns >= 2 && whole.n_rows >= 2,
                    ExcUser(
                      text("The raster '",
                           file_,
                           "' has ",
                           whole.n_rows,
                           " rows and ",
                           whole.n_columns,
                           " columns, but a surface needs two of both.")));
        if (map.empty())
          check_in_metres(file, whole);
        return part_around(whole, plan, map);
      },
      has_heights());
    return map.empty()
             ? raster
             : project_raster(std::move(raster),
                              map,
                              cell_size_,
                              path("Projection") + " = " + projection_);
  }



  template <int dim>
  std::shared_ptr<const Surface<dim>>
  NamedSurface<dim>::read_outlines(const std::filesystem::path &file,
                                   const Point<3>              &origin) const
  {
    const std::string entry = "Surfaces/" + name_;
    std::string       name  = "The outline in " + path("Outline");
    MapCorners        outlines;
    if (outline_.empty())
      {
        protect_input(file);
        name     = "The outline '" + file_ + "'";
        outlines = talus::read_outlines(file, attribute_);
        for (auto &corners : outlines.parts)
          bring_to_map(corners,
                       outlines.coordinate_system,
                       map(),
                       name,
                       path("Projection"));
      }
    else
      {
        auto &corners = outlines.parts.emplace_back();
        for (const auto &place : Utilities::split_string_list(outline_, ';'))
          {
            const Point<3> x = parse_plan_place<3>(
              entry + "/Outline",
              place,
              PlaceCoordinates(entry, coordinates_, 3, origin).kind(),
              origin);
            corners.emplace_back(origin[0] + x[0], origin[1] - x[2]);
          }
      }
    return std::make_shared<OutlineSurface<dim>>(name,
                                                 outlines.parts,
                                                 outlines.numbers,
                                                 PlanOnMap<dim>(origin,
                                                                section()));
  }



  template <int dim>
  void
  NamedSurface<dim>::check_entries() const
  {
    const unsigned int n_given =
      !file_.empty() + !expression_.empty() + !outline_.empty();
    AssertThrow(n_given == 1,
                ExcUser(text("The section Surfaces/",
                             name_,
                             " has ",
                             n_given == 0 ? "none" : "more than one",
                             " of the entries `File`, `Expression` and "
                             "`Outline`. Give one of them.")));
    AssertThrow(dim == 3 || outline_.empty() || coordinates_ == "map",
                ExcUser(text(path("Outline"),
                             " has corners x, z of the mesh, but a mesh in 2-D "
                             "has no z. Give easting and northing, with ",
                             path("Coordinates"),
                             " = map.")));
    AssertThrow(attribute_.empty() || !file_.empty(),
                ExcUser(text(path("Attribute"),
                             " is '",
                             attribute_,
                             "', a field of the polygons of a `File`, but "
                             "there is none. Remove the entry.")));
    AssertThrow(has_heights() || has_file(),
                ExcUser(text(path("Quantity"),
                             " is 'other', which is for the raster of a "
                             "`File`, but there is none. Remove the entry.")));
    AssertThrow(coordinates_ == "mesh" || !outline_.empty(),
                ExcUser(text(path("Coordinates"),
                             " is '",
                             coordinates_,
                             "', which is for an `Outline`, but there is none. "
                             "Remove the entry.")));
  }



  namespace
  {
    /// Return the box around the mesh on the map, m.
    Box<2>
    plan_of(const Box<3>   &mesh,
            const Point<3> &origin,
            const std::vector<Point<2>> & /*section*/)
    {
      return {Point<2>(origin[0] + mesh.lower[0], origin[1] - mesh.upper[2]),
              Point<2>(origin[0] + mesh.upper[0], origin[1] - mesh.lower[2])};
    }



    /// In 2-D: the box around the part of the section in the mesh.
    Box<2>
    plan_of(const Box<2> &mesh,
            const Point<3> & /*origin*/,
            const std::vector<Point<2>> &section)
    {
      std::vector<Point<2>> places;
      double                length = 0.;
      for (std::size_t i = 1; i < section.size(); ++i)
        {
          const Tensor<1, 2> leg = section[i] - section[i - 1];
          const double       end = length + leg.norm();
          // The first and the last leg are endless.
          const double from =
            i == 1 ? mesh.lower[0] : std::max(mesh.lower[0], length);
          const double to = i + 1 == section.size()
                              ? mesh.upper[0]
                              : std::min(mesh.upper[0], end);
          for (const double x : {from, to})
            if (from <= to)
              places.push_back(section[i - 1] +
                               (x - length) / leg.norm() * leg);
          length = end;
        }
      return bounding_box(places);
    }
  } // namespace



  template <int dim>
  std::shared_ptr<const Surface<dim>>
  NamedSurface<dim>::read(const std::filesystem::path &folder,
                          const Point<3>              &origin,
                          const Box<dim>              &mesh,
                          const double                 cell_size) const
  {
    if (!outline_.empty() || is_outline_file(file(folder)))
      return read_outlines(file(folder), origin);
    AssertThrow(attribute_.empty(),
                ExcUser(text(path("Attribute"),
                             " is '",
                             attribute_,
                             "', a field of polygons, but '",
                             file_,
                             "' is a raster. Remove the entry.")));
    const auto corners = section();
    Raster     raster = read_file(file(folder), plan_of(mesh, origin, corners));
    raster.has_heights = has_heights(); // not kept by a projection
    smooth(raster, cell_size);
    return std::make_shared<Terrain<dim>>(std::make_shared<const HeightField>(
                                            std::move(raster)),
                                          file_,
                                          PlanOnMap<dim>(origin, corners));
  }



  template class NamedSurface<2>;
  template class NamedSurface<3>;
} // namespace talus

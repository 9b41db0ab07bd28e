// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/coordinate_system.h>
#include <talus/io/gdal.h>
#include <talus/io/map_outline.h>
#include <talus/io/raster_file.h>
#include <talus/io/text_file.h>

#include <deal.II/base/patterns.h>

#include <optional>
#include <regex>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Corners = std::vector<Point<2>>;

    /// All polygons and lines of a GIS file.
    struct MapFeatures
    {
      struct Area
      {
        std::vector<Corners>  rings; ///< the outer one first
        std::optional<double> number;
      };

      std::vector<Area>    polygons;
      std::vector<Corners> lines;
      /// As Raster::coordinate_system.
      std::string coordinate_system;
    };



    Corners
    corners_of(const OGRSimpleCurve &curve)
    {
      Corners corners;
      for (const OGRPoint &corner : curve)
        corners.emplace_back(corner.getX(), corner.getY());
      return corners;
    }



    /// Append the polygons, with their @p number, and lines of a geometry and
    /// its parts.
    void
    collect(const OGRGeometry          &geometry,
            const std::optional<double> number,
            MapFeatures                &result)
    {
      if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon)
        {
          auto &polygon  = result.polygons.emplace_back();
          polygon.number = number;
          for (const OGRLinearRing *ring : *geometry.toPolygon())
            polygon.rings.push_back(corners_of(*ring));
        }
      else if (wkbFlatten(geometry.getGeometryType()) == wkbLineString)
        result.lines.push_back(corners_of(*geometry.toLineString()));
      else if (OGR_GT_IsSubClassOf(geometry.getGeometryType(),
                                   wkbGeometryCollection))
        for (const OGRGeometry *part : *geometry.toGeometryCollection())
          collect(*part, number, result);
    }



    /// Return the number in a field of a feature, if there is one.
    std::optional<double>
    number_of(const OGRFeature &feature, const int field)
    {
      if (field < 0 || !feature.IsFieldSetAndNotNull(field))
        return {};
      const std::string words = feature.GetFieldAsString(field);
      return Patterns::Double().match(words)
               ? std::optional<double>(feature.GetFieldAsDouble(field))
               : std::nullopt;
    }



    /// Append the polygons and lines of a layer, curved edges as many short
    /// edges, and the number of each polygon in the field @p attribute. A layer
    /// with any of them sets the coordinate system.
    void
    collect(OGRLayer &layer, const std::string &attribute, MapFeatures &result)
    {
      const auto n = [&result]() {
        return result.polygons.size() + result.lines.size();
      };
      const std::size_t n_before = n();
      const int field = layer.GetLayerDefn()->GetFieldIndex(attribute.c_str());
      for (const OGRFeatureUniquePtr &feature : layer)
        if (const OGRGeometry *geometry = feature->GetGeometryRef())
          collect(*std::unique_ptr<OGRGeometry>(geometry->getLinearGeometry()),
                  number_of(*feature, field),
                  result);
      if (n() > n_before)
        result.coordinate_system = layer.GetSpatialRef() == nullptr
                                     ? ""
                                     : export_to_text(*layer.GetSpatialRef());
    }



    /// Return the coordinate system that a GeoJSON file names; GDAL takes a
    /// name that it does not know for WGS 84. Empty without a name.
    std::string
    name_in_geojson(const std::filesystem::path &file)
    {
      const std::string words = read_text_file(file).value_or("");
      const std::size_t begin = words.find("\"crs\"");
      if (begin == std::string::npos)
        return "";
      std::smatch       parts;
      const std::string member = words.substr(begin, 500);
      const std::regex  name(
        R"re("crs"\s*:\s*\{[^{}]*\{\s*"name"\s*:\s*"([^"]*)")re");
      return std::regex_search(member, parts, name) ? parts.str(1) : "";
    }



    /// Read the polygons, with the numbers of an @p attribute, and lines of all
    /// layers of a file.
    MapFeatures
    read_features(const std::filesystem::path &path,
                  const std::string           &attribute = "")
    {
      const QuietGdal quiet;
      GDALAllRegister();
      const std::string          name = "The file '" + path.string() + "'";
      const GDALDatasetUniquePtr file(
        std::filesystem::is_fifo(path)
          ? nullptr
          : GDALDataset::Open(path.c_str(),
                              GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
      AssertThrow(file != nullptr,
                  ExcUser(
                    text(name,
                         " cannot be read (",
                         CPLGetLastErrorMsg(),
                         "). Give the path of an existing file of vectors "
                         "(GeoJSON, shapefile, GeoPackage, KML).")));
      MapFeatures result;
      for (OGRLayer *layer : file->GetLayers())
        collect(*layer, attribute, result);
      if (file->GetDriver()->GetDescription() == std::string("GeoJSON"))
        check_understood(name_in_geojson(path), name);
      // GDAL leaves out a system that it does not understand.
      if (result.coordinate_system.empty())
        result.coordinate_system = systems_beside(path).coordinate_system;
      check_understood(result.coordinate_system, name);
      return result;
    }
  } // namespace



  bool
  is_outline_file(const std::filesystem::path &file)
  {
    const QuietGdal quiet;
    GDALAllRegister();
    std::error_code error;
    const auto      is_readable = [&file](const unsigned int kind) {
      return GDALDatasetUniquePtr(GDALDataset::Open(file.c_str(), kind)) !=
             nullptr;
    };
    return std::filesystem::is_regular_file(file, error) &&
           !is_readable(GDAL_OF_RASTER) && is_readable(GDAL_OF_VECTOR);
  }



  MapCorners
  read_outlines(const std::filesystem::path &file, const std::string &attribute)
  {
    const MapFeatures found = read_features(file, attribute);
    const std::string name  = "The outline '" + file.string() + "' ";
    AssertThrow(!found.polygons.empty(),
                ExcUser(name +
                        "has no polygon, where one or more were expected. Save "
                        "the release area as a polygon."));
    MapCorners outlines{{}, {}, found.coordinate_system};
    for (const auto &[rings, number] : found.polygons)
      {
        AssertThrow(rings.size() == 1,
                    ExcUser(text(name,
                                 "has a polygon of ",
                                 rings.size(),
                                 " rings, where one was expected: the outline, "
                                 "without holes. Remove the holes.")));
        AssertThrow(attribute.empty() || number.has_value(),
                    ExcUser(text(name,
                                 "has a polygon without a number in the field "
                                 "'",
                                 attribute,
                                 "', where each polygon was expected to have "
                                 "one. Correct the name of the field, or fill "
                                 "it in.")));
        auto &corners = outlines.parts.emplace_back(rings[0]);
        if (corners.size() > 1 && corners.front() == corners.back())
          corners.pop_back();
        if (!attribute.empty())
          outlines.numbers.push_back(*number);
      }
    return outlines;
  }



  MapCorners
  read_line(const std::filesystem::path &file)
  {
    const MapFeatures found = read_features(file);
    AssertThrow(found.lines.size() == 1,
                ExcUser(text("The route '",
                             file.string(),
                             "' has ",
                             found.lines.size(),
                             " lines, where one was expected. Save one line to "
                             "a file of its own.")));
    return {{found.lines[0]}, {}, found.coordinate_system};
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/gdal.h>
#include <talus/io/gdal_features.h>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    MapFeatures::Corners
    corners_of(const OGRSimpleCurve &curve)
    {
      MapFeatures::Corners corners;
      for (const OGRPoint &corner : curve)
        corners.emplace_back(corner.getX(), corner.getY());
      return corners;
    }



    /// Append the polygons and lines of a geometry and its parts.
    void
    collect(const OGRGeometry &geometry, MapFeatures &result)
    {
      if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon)
        {
          auto &polygon = result.polygons.emplace_back();
          for (const OGRLinearRing *ring : *geometry.toPolygon())
            polygon.push_back(corners_of(*ring));
        }
      else if (wkbFlatten(geometry.getGeometryType()) == wkbLineString)
        result.lines.push_back(corners_of(*geometry.toLineString()));
      else if (OGR_GT_IsSubClassOf(geometry.getGeometryType(),
                                   wkbGeometryCollection))
        for (const OGRGeometry *part : *geometry.toGeometryCollection())
          collect(*part, result);
    }
  } // namespace



  bool
  has_gdal_features(const std::filesystem::path &file)
  {
    const QuietGdal quiet;
    GDALAllRegister();
    const auto is_readable = [&file](const unsigned int kind) {
      return GDALDatasetUniquePtr(GDALDataset::Open(file.c_str(), kind)) !=
             nullptr;
    };
    return !is_readable(GDAL_OF_RASTER) && is_readable(GDAL_OF_VECTOR);
  }



  MapFeatures
  read_gdal_features(const std::filesystem::path &path)
  {
    const QuietGdal quiet;
    GDALAllRegister();
    const GDALDatasetUniquePtr file(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
    AssertThrow(file != nullptr,
                ExcUser(
                  text("The file '",
                       path.string(),
                       "' cannot be read (",
                       CPLGetLastErrorMsg(),
                       "). Save the file anew, or convert the file: ogr2ogr "
                       "OUT.geojson IN.")));
    MapFeatures result;
    for (OGRLayer *layer : file->GetLayers())
      {
        const auto n = [&result]() {
          return result.polygons.size() + result.lines.size();
        };
        const std::size_t n_before = n();
        for (const OGRFeatureUniquePtr &feature : *layer)
          if (const OGRGeometry *geometry = feature->GetGeometryRef())
            collect(*std::unique_ptr<OGRGeometry>(
                      geometry->getLinearGeometry()),
                    result);
        if (n() > n_before)
          result.coordinate_system =
            layer->GetSpatialRef() == nullptr
              ? ""
              : export_to_text(*layer->GetSpatialRef());
      }
    return result;
  }
} // namespace talus

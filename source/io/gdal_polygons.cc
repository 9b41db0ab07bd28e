// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/gdal.h>
#include <talus/io/gdal_polygons.h>

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    MapPolygons::Ring
    corners_of(const OGRLinearRing &ring)
    {
      MapPolygons::Ring corners;
      for (const OGRPoint &corner : ring)
        corners.emplace_back(corner.getX(), corner.getY());
      return corners;
    }



    /// Append the polygons of a geometry and of all in it.
    void
    collect_polygons(const OGRGeometry &geometry, MapPolygons &result)
    {
      if (wkbFlatten(geometry.getGeometryType()) == wkbPolygon)
        {
          auto &polygon = result.polygons.emplace_back();
          for (const OGRLinearRing *ring : *geometry.toPolygon())
            polygon.push_back(corners_of(*ring));
        }
      else if (OGR_GT_IsSubClassOf(geometry.getGeometryType(),
                                   wkbGeometryCollection))
        for (const OGRGeometry *part : *geometry.toGeometryCollection())
          collect_polygons(*part, result);
    }
  } // namespace



  bool
  has_gdal_polygons(const std::filesystem::path &file)
  {
    const QuietGdal quiet;
    GDALAllRegister();
    const auto is_readable = [&file](const unsigned int kind) {
      return GDALDatasetUniquePtr(GDALDataset::Open(file.c_str(), kind)) !=
             nullptr;
    };
    return !is_readable(GDAL_OF_RASTER) && is_readable(GDAL_OF_VECTOR);
  }



  MapPolygons
  read_gdal_polygons(const std::filesystem::path &path)
  {
    const QuietGdal quiet;
    GDALAllRegister();
    const GDALDatasetUniquePtr file(
      GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR));
    AssertThrow(file != nullptr,
                ExcUser(text("The outline '",
                             path.string(),
                             "' cannot be read (",
                             CPLGetLastErrorMsg(),
                             "). Save it anew, or convert it: ogr2ogr "
                             "OUT.geojson IN.")));
    MapPolygons result;
    for (OGRLayer *layer : file->GetLayers())
      {
        const std::size_t n_before = result.polygons.size();
        for (const OGRFeatureUniquePtr &feature : *layer)
          if (const OGRGeometry *geometry = feature->GetGeometryRef())
            collect_polygons(*std::unique_ptr<OGRGeometry>(
                               geometry->getLinearGeometry()),
                             result);
        if (result.polygons.size() > n_before)
          result.coordinate_system =
            layer->GetSpatialRef() == nullptr
              ? ""
              : export_to_text(*layer->GetSpatialRef());
      }
    return result;
  }
} // namespace talus

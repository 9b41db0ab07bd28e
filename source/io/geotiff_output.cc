// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/gdal.h>
#include <talus/io/gdal_raster.h>

#include <array>
#include <cmath>
#include <memory>

#include <cpl_vsi.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Write frame and values into @p dataset and return whether GDAL
    /// succeeded. Rows of the raster and of the GeoTIFF begin in the north.
    bool
    fill(GDALDataset &dataset, const Raster &raster)
    {
      std::array<double, 6> frame = {
        {raster.west, raster.dx, 0., raster.north(), 0., -raster.dy}};
      std::vector<double> values = raster.values;
      for (double &value : values)
        if (std::isnan(value))
          value = raster.nodata;
      const auto system = spatial_reference(raster.coordinate_system);
      const int  n = raster.n_columns, m = raster.n_rows;
      GDALRasterBand *const band = dataset.GetRasterBand(1);
      return dataset.SetGeoTransform(frame.data()) == CE_None &&
             (!system || dataset.SetSpatialRef(&*system) == CE_None) &&
             band->SetNoDataValue(raster.nodata) == CE_None &&
             band->RasterIO(GF_Write,
                            0,
                            0,
                            n,
                            m,
                            values.data(),
                            n,
                            m,
                            GDT_Float64,
                            0,
                            0,
                            nullptr) == CE_None;
    }
  } // namespace



  void
  check_geotiff(const std::string &coordinate_system)
  {
    AssertThrow(
      coordinate_system.empty() || spatial_reference(coordinate_system),
      ExcUser(text("The coordinate system of the raster, '",
                   coordinate_system.substr(0, 60),
                   coordinate_system.size() > 60 ? "..." : "",
                   "', is not known to GDAL: no GeoTIFF can be written. "
                   "Correct the coordinate system in the raster or the .prj "
                   "file beside the raster, or set 'Maps/Write GeoTIFF' to "
                   "false.")));
  }



  void
  write_geotiff(const std::filesystem::path &file, const Raster &raster)
  {
    check_geotiff(raster.coordinate_system);
    const QuietGdal quiet;
    GDALRegister_GTiff();
    // In the memory of this process: write_file() then brings the content to
    // the disk like all output.
    const char *const    name      = "/vsimem/talus.tif";
    const char *const    options[] = {"COMPRESS=DEFLATE", nullptr};
    GDALDatasetUniquePtr dataset(
      GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        name,
        raster.n_columns,
        raster.n_rows,
        1,
        GDT_Float64,
        const_cast<char **>(options)));
    const bool is_filled = dataset != nullptr && fill(*dataset, raster);
    dataset.reset(); // completes the file
    AssertThrow(is_filled && CPLGetLastErrorType() < CE_Failure,
                ExcUser(failed_write(file, CPLGetLastErrorMsg())));
    vsi_l_offset                                     n = 0;
    const std::unique_ptr<GByte, decltype(&VSIFree)> content(
      VSIGetMemFileBuffer(name, &n, true), &VSIFree);
    write_file(file, [&](std::ostream &out) {
      out.write(reinterpret_cast<const char *>(content.get()), n);
    });
  }
} // namespace talus

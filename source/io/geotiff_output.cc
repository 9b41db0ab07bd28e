// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/geotiff_raster.h>
#include <talus/version.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <type_traits>

#if TALUS_WITH_GDAL
#  include <talus/io/quiet_gdal.h>

#  include <cpl_vsi.h>
#  include <gdal.h>
#  include <gdal_frmts.h>
#  include <ogr_srs_api.h>
#endif

namespace talus
{
  using namespace dealii;

#if TALUS_WITH_GDAL
  namespace
  {
    using System = std::unique_ptr<std::remove_pointer_t<OGRSpatialReferenceH>,
                                   decltype(&OSRDestroySpatialReference)>;

    /// Null if @p words are empty. Throws ExcUser if GDAL does not know them.
    System
    system_of(const std::string &words)
    {
      if (words.empty())
        return System(nullptr, OSRDestroySpatialReference);
      const QuietGdal quiet;
      System          system(OSRNewSpatialReference(nullptr),
                    OSRDestroySpatialReference);
      // OSRSetFromUserInput() would also open files and addresses.
      std::string  copy = words;
      char        *rest = copy.data();
      const OGRErr error =
        words.rfind("EPSG:", 0) == 0
          ? OSRImportFromEPSG(system.get(), std::atoi(words.c_str() + 5))
          : OSRImportFromWkt(system.get(), &rest);
      AssertThrow(error == OGRERR_NONE,
                  ExcUser(text("The coordinate system of the raster, '",
                               words.substr(0, 60),
                               words.size() > 60 ? "..." : "",
                               "', is not known to GDAL (",
                               CPLGetLastErrorMsg(),
                               "), so that no GeoTIFF can be written on it. "
                               "Correct it in the raster or the .prj file "
                               "beside it, or set 'Maps/Write GeoTIFF' to "
                               "false.")));
      return system;
    }



    /// A file in the memory of this process, so that what reaches the disk goes
    /// the way of all output.
    class FileInMemory
    {
    public:
      FileInMemory()
      {
        VSIUnlink(name);
      }
      ~FileInMemory()
      {
        VSIUnlink(name);
      }
      FileInMemory(const FileInMemory &) = delete;
      FileInMemory &
      operator=(const FileInMemory &) = delete;

      std::string
      content() const
      {
        vsi_l_offset      n     = 0;
        const auto *const bytes = VSIGetMemFileBuffer(name, &n, false);
        return {reinterpret_cast<const char *>(bytes), std::size_t(n)};
      }

      static constexpr const char *name = "/vsimem/talus.tif";
    };



    /// Whether GDAL did all of it. The rows of both begin in the north.
    bool
    fill(const GDALDatasetH         dataset,
         const Raster              &raster,
         const OGRSpatialReferenceH system)
    {
      std::array<double, 6> frame  = {{raster.west,
                                       raster.dx,
                                       0.,
                                       raster.south + raster.n_rows * raster.dy,
                                       0.,
                                       -raster.dy}};
      std::vector<double>   values = raster.values;
      for (double &value : values)
        if (std::isnan(value))
          value = raster.nodata;
      const int             n = raster.n_columns, m = raster.n_rows;
      const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
      return GDALSetGeoTransform(dataset, frame.data()) == CE_None &&
             (system == nullptr ||
              GDALSetSpatialRef(dataset, system) == CE_None) &&
             GDALSetRasterNoDataValue(band, raster.nodata) == CE_None &&
             GDALRasterIO(band,
                          GF_Write,
                          0,
                          0,
                          n,
                          m,
                          values.data(),
                          n,
                          m,
                          GDT_Float64,
                          0,
                          0) == CE_None;
    }
  } // namespace



  void
  check_geotiff(const std::string &coordinate_system)
  {
    system_of(coordinate_system);
  }



  void
  write_geotiff(const std::filesystem::path &file, const Raster &raster)
  {
    const System       system = system_of(raster.coordinate_system);
    const QuietGdal    quiet;
    const FileInMemory memory;
    GDALRegister_GTiff();
    const char *const  options[] = {"COMPRESS=DEFLATE", nullptr};
    const GDALDatasetH dataset   = GDALCreate(GDALGetDriverByName("GTiff"),
                                            memory.name,
                                            raster.n_columns,
                                            raster.n_rows,
                                            1,
                                            GDT_Float64,
                                            const_cast<char **>(options));
    const bool         is_filled =
      dataset != nullptr && fill(dataset, raster, system.get());
    // Only now is all of it in the file.
    if (dataset != nullptr)
      GDALClose(dataset);
    AssertThrow(is_filled && CPLGetLastErrorType() < CE_Failure,
                ExcUser(failed_write(file, CPLGetLastErrorMsg())));
    write_file(file, [&](std::ostream &out) { out << memory.content(); });
  }

#else

  void
  check_geotiff(const std::string &)
  {
    AssertThrow(false,
                ExcUser("'Maps/Write GeoTIFF' is true, but this talus was "
                        "built without GDAL, which writes GeoTIFF. Set it to "
                        "false and convert the maps with 'gdal_translate "
                        "in.asc out.tif', or install Debian's package "
                        "libgdal-dev, configure and build again."));
  }



  void
  write_geotiff(const std::filesystem::path &, const Raster &raster)
  {
    check_geotiff(raster.coordinate_system);
  }
#endif
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_gdal_h
#define talus_io_gdal_h

// Only for files that are compiled with GDAL's headers.
#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <optional>
#include <string>

namespace talus
{
  /// Silence GDAL for the lifetime of this object: GDAL prints no errors, and
  /// CPLGetLastErrorMsg() returns the last message.
  struct QuietGdal
  {
    QuietGdal()
    {
      CPLPushErrorHandler(CPLQuietErrorHandler);
      CPLErrorReset();
    }
    ~QuietGdal()
    {
      CPLPopErrorHandler();
    }
    QuietGdal(const QuietGdal &) = delete;
    QuietGdal &
    operator=(const QuietGdal &) = delete;
  };



  /// Return the coordinate system described by @p words (see
  /// Raster::coordinate_system), with longitude or easting as the first axis.
  /// Nothing if GDAL does not know the system.
  std::optional<OGRSpatialReference>
  spatial_reference(const std::string &words);



  /// Return @p system as well-known text in the dialect given by @p options;
  /// empty if the system has no text in the dialect.
  std::string
  export_to_text(const OGRSpatialReference &system,
                 const char *const         *options = nullptr);
} // namespace talus

#endif

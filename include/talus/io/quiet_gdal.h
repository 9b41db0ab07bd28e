// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_quiet_gdal_h
#define talus_io_quiet_gdal_h

// Only for files that are compiled with GDAL's headers.
#include <cpl_error.h>

namespace talus
{
  /// Errors of GDAL are not printed: their words go into ours.
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
} // namespace talus

#endif

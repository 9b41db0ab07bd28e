// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/map_projection.h>
#include <talus/version.h>

#include <cmath>
#include <optional>
#include <regex>

#if TALUS_WITH_PROJ
#  include <proj.h>
#endif

namespace talus
{
  using namespace dealii;

  std::string
  UtmZone::name() const
  {
    return text("UTM ", number, is_south ? 'S' : 'N');
  }



  UtmZone
  utm_zone(const double longitude, const double latitude)
  {
    const double from_date_line =
      longitude + 180. - 360. * std::floor((longitude + 180.) / 360.);
    return {static_cast<unsigned int>(from_date_line / 6.) + 1, latitude < 0.};
  }



#if TALUS_WITH_PROJ
  /// Each has a context of its own, so that nothing is shared with whoever else
  /// uses PROJ in this program.
  struct MapProjection::Library
  {
    Library()
      : context(proj_context_create())
    {
      proj_log_level(context, PJ_LOG_NONE);
    }

    ~Library()
    {
      proj_destroy(transformation);
      proj_context_destroy(context);
    }

    Library(const Library &) = delete;
    Library &
    operator=(const Library &) = delete;

    /// Why the last call failed.
    std::string
    reason() const
    {
      const int   number = proj_context_errno(context);
      const char *words =
        (number == 0 ? nullptr : proj_context_errno_string(context, number));
      return words == nullptr ? "no reason given" : words;
    }

    PJ_CONTEXT *const context;
    PJ               *transformation = nullptr; ///< degrees to metres
  };



  namespace
  {
    using Projection = std::unique_ptr<PJ, decltype(&proj_destroy)>;

    /// Nothing if @p name is none.
    std::optional<UtmZone>
    zone_of(const std::string &name)
    {
      std::smatch parts;
      if (!std::regex_match(name, parts, std::regex("UTM ?([0-9]{1,2})([NS])")))
        return {};
      return UtmZone{static_cast<unsigned int>(std::stoul(parts[1])),
                     parts[2] == "S"};
    }



    /// By the formulas alone: PROJ's database, a file beside the library, is
    /// not needed.
    PJ *
    utm(PJ_CONTEXT *const context, const UtmZone &zone)
    {
      return proj_create(context,
                         text("+proj=pipeline +step +proj=unitconvert "
                              "+xy_in=deg +xy_out=rad +step +proj=utm +zone=",
                              zone.number,
                              zone.is_south ? " +south" : "",
                              " +ellps=WGS84")
                           .c_str());
    }



    /// Whether both axes of this coordinate system are lengths in metres.
    bool
    is_map_in_metres(PJ_CONTEXT *const context, const PJ *const system)
    {
      if (proj_get_type(system) != PJ_TYPE_PROJECTED_CRS)
        return false;
      const Projection axes(proj_crs_get_coordinate_system(context, system),
                            proj_destroy);
      double           unit = 0.;
      return proj_cs_get_axis_info(context,
                                   axes.get(),
                                   0,
                                   nullptr,
                                   nullptr,
                                   nullptr,
                                   &unit,
                                   nullptr,
                                   nullptr,
                                   nullptr) != 0 &&
             unit == 1.;
    }



    /// By PROJ's database, in which also the order of the axes is: the result
    /// has longitude and easting first.
    PJ *
    from_database(PJ_CONTEXT *const  context,
                  const std::string &path,
                  const std::string &name)
    {
      const Projection system(proj_create(context, name.c_str()), proj_destroy);
      AssertThrow(!system || is_map_in_metres(context, system.get()),
                  ExcUser(text(path,
                               " = '",
                               name,
                               "' is no map whose easting and northing are in "
                               "metres. Give a projected coordinate system, "
                               "such as UTM 33N.")));
      const Projection any_axes(
        system
          ? proj_create_crs_to_crs(context, "EPSG:4326", name.c_str(), nullptr)
          : nullptr,
        proj_destroy);
      return any_axes
               ? proj_normalize_for_visualization(context, any_axes.get())
               : nullptr;
    }
  } // namespace



  MapProjection::MapProjection(const std::string &path, const std::string &name)
    : library_(std::make_shared<Library>())
  {
    const bool has_number = std::regex_match(name, std::regex("EPSG:[0-9]+"));
    const auto zone       = zone_of(name);
    if (has_number)
      library_->transformation = from_database(library_->context, path, name);
    else if (zone)
      library_->transformation = utm(library_->context, *zone);
    coordinate_system_ = zone ? text("EPSG:", zone->epsg()) : name;
    AssertThrow(library_->transformation != nullptr,
                ExcUser(text(path,
                             " = '",
                             name,
                             "' was found, where a UTM zone from 1 to 60 and "
                             "its hemisphere were expected, as UTM 33N or UTM "
                             "33S, or the number of a map in PROJ's database, "
                             "as EPSG:3575. Correct it",
                             has_number
                               ? text(" (PROJ: ", library_->reason(), ").")
                               : ".")));
  }



  bool
  MapProjection::is_available()
  {
    return true;
  }



  Point<2>
  MapProjection::forward(const Point<2> &place) const
  {
    const PJ_COORD result = proj_trans(library_->transformation,
                                       PJ_FWD,
                                       proj_coord(place[0], place[1], 0., 0.));
    return {result.xy.x, result.xy.y};
  }



  Point<2>
  MapProjection::inverse(const Point<2> &place) const
  {
    const PJ_COORD result = proj_trans(library_->transformation,
                                       PJ_INV,
                                       proj_coord(place[0], place[1], 0., 0.));
    return {result.xy.x, result.xy.y};
  }



  namespace
  {
    std::string
    in_words_of_esri(const std::string &name)
    {
      const std::unique_ptr<PJ_CONTEXT, decltype(&proj_context_destroy)>
        context(proj_context_create(), proj_context_destroy);
      proj_log_level(context.get(), PJ_LOG_NONE);
      const Projection system(proj_create(context.get(), name.c_str()),
                              proj_destroy);
      const char      *words =
        system ? proj_as_wkt(context.get(), system.get(), PJ_WKT1_ESRI, nullptr)
                    : nullptr;
      return words == nullptr ? "" : words;
    }
  } // namespace



#else
  struct MapProjection::Library
  {};



  MapProjection::MapProjection(const std::string &path, const std::string &name)
  {
    AssertThrow(false,
                ExcUser(text(path,
                             " = '",
                             name,
                             "' needs the library PROJ, without which this "
                             "talus was built. Install Debian's package "
                             "libproj-dev, configure and build again.")));
  }



  bool
  MapProjection::is_available()
  {
    return false;
  }



  Point<2>
  MapProjection::forward(const Point<2> &) const
  {
    return {};
  }



  Point<2>
  MapProjection::inverse(const Point<2> &) const
  {
    return {};
  }



  namespace
  {
    std::string
    in_words_of_esri(const std::string &)
    {
      return "";
    }
  } // namespace
#endif



  std::string
  well_known_text(const std::string &coordinate_system)
  {
    return coordinate_system.rfind("EPSG:", 0) == 0
             ? in_words_of_esri(coordinate_system)
             : coordinate_system;
  }
} // namespace talus

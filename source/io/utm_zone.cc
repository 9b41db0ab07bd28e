// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/utm_zone.h>

#include <cmath>
#include <regex>

namespace talus
{
  using namespace dealii;

  std::string
  UtmZone::name() const
  {
    return text("UTM ", number, is_south ? 'S' : 'N');
  }



  std::string
  UtmZone::epsg_code() const
  {
    return text("EPSG:", (is_south ? 32700 : 32600) + number);
  }



  UtmZone
  utm_zone(const double longitude, const double latitude)
  {
    const double from_date_line =
      longitude + 180. - 360. * std::floor((longitude + 180.) / 360.);
    return {static_cast<unsigned int>(from_date_line / 6.) + 1, latitude < 0.};
  }



  std::string
  epsg_code(const std::string &path, const std::string &name)
  {
    std::smatch parts;
    if (std::regex_match(name, std::regex("EPSG:[0-9]+")))
      return name;
    if (std::regex_match(name,
                         parts,
                         std::regex("UTM ?([1-9]|[1-5][0-9]|60)([NS])")))
      return UtmZone{static_cast<unsigned int>(std::stoul(parts[1])),
                     parts[2] == "S"}
        .epsg_code();
    AssertThrow(false,
                ExcUser(text(
                  path,
                  " = '",
                  name,
                  "' was found, where a UTM zone from 1 to 60 and a "
                  "hemisphere were expected, such as UTM 33N or UTM 33S, or "
                  "the code of a map, such as EPSG:3575. Correct the entry.")));
    return "";
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/length_unit.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/replace.hpp>
#include <boost/algorithm/string/trim.hpp>

#include <map>

namespace talus
{
  // Names are compared in one spelling: small letters, blanks between words,
  // British, in the singular.
  double
  length_of_unit(std::string name)
  {
    boost::to_lower(name);
    for (char &c : name)
      if (c == '_' || c == '-')
        c = ' ';
    boost::trim_if(name, boost::is_any_of(" []()."));
    boost::replace_all(name, "meter", "metre");
    boost::replace_all(name, "feet", "foot");
    boost::trim_right_if(name, boost::is_any_of("s"));
    constexpr double                           survey  = 1200. / 3937.;
    static const std::map<std::string, double> lengths = {
      {"m", 1.},
      {"metre", 1.},
      {"km", 1e3},
      {"kilometre", 1e3},
      {"dm", 0.1},
      {"decimetre", 0.1},
      {"cm", 0.01},
      {"centimetre", 0.01},
      {"mm", 1e-3},
      {"millimetre", 1e-3},
      {"ft", 0.3048},
      {"foot", 0.3048},
      {"international foot", 0.3048},
      {"us survey foot", survey},
      {"us foot", survey},
      {"us ft", survey},
      {"foot u", survey}, // Foot_US
      {"ftu", survey},    // ftUS
      {"fathom", 1.8288}};
    const auto found = lengths.find(name);
    return found == lengths.end() ? 0. : found->second;
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/unusual_values.h>
#include <talus/base/errors.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Values = std::map<std::string, std::string>;

    constexpr double infinity = std::numeric_limits<double>::infinity();

    /// Usual values of a parameter.
    struct UsualRange
    {
      std::string section; ///< first part of the path, with a slash; or empty
      std::string entry;
      double      from, to;
      std::string unit; ///< with a blank before the unit
      std::string reason = "are usual";
    };



    /// Return the number at @p path; NaN if there is none.
    double
    number(const Values &values, const std::string &path)
    {
      const auto   value    = values.find(path);
      char        *end      = nullptr;
      const bool   is_there = value != values.end() && !value->second.empty();
      const double result =
        is_there ? std::strtod(value->second.c_str(), &end) : 0.;
      return is_there && *end == '\0' ? result : std::nan("");
    }



    /// Return the longest edge of the mesh, m.
    double
    length_of_mesh(const Values &values)
    {
      const auto corner = [&values](const std::string &path) {
        const auto text = values.find(path);
        return Utilities::string_to_double(
          Utilities::split_string_list(text == values.end() ? "" : text->second,
                                       ','));
      };
      const auto lower = corner("Grid/Lower corner"),
                 upper = corner("Grid/Upper corner");
      double result    = 0.;
      for (std::size_t d = 0; d < std::min(lower.size(), upper.size()); ++d)
        result = std::max(result, upper[d] - lower[d]);
      return result;
    }



    /// Return the smallest of the numbers for undrained shear strengths, Pa; 0
    /// without one.
    double
    smallest_strength(const Values &values)
    {
      double least = infinity;
      for (const auto &[path, text] : values)
        if (boost::ends_with(path, "/Undrained shear strength"))
          least = std::fmin(least, number(values, path));
      return least < infinity ? least : 0.;
    }



    /// The table: ranges from light foam to metals and from flumes to oceans,
    /// so that a value outside is hardly ever meant.
    std::vector<UsualRange>
    usual_ranges(const Values &values)
    {
      const double      length  = length_of_mesh(values);
      const std::string by_mesh = "fit, up to the longest edge of the mesh";
      return {{"Materials/", "Density", 0.1, 3e4, " kg/m^3"},
              {"Materials/", "Consistency", 1e-6, 1e6, " Pa s^n"},
              {"Water/", "Density", 0.1, 5e3, " kg/m^3"},
              {"Water/", "Added mass coefficient", 1e-4, 10., ""},
              {"Obstacles/", "Mass", 1e-6, 1e10, " kg"},
              {"", "Friction coefficient", 1e-4, 100., ""},
              {"",
               "Maximum shear stress",
               smallest_strength(values) / 300.,
               infinity,
               " Pa",
               "fit the strength of the soil"},
              {"", "Slip to remould", 1e-6, 1e3, " m"},
              {"", "Film consistency", 1e-6, 1e6, " Pa s^n"},
              {"", "Film thickness", 1e-6, 1e2, " m"},
              {"Maps/", "Cell size", 0., length, " m", by_mesh},
              {"Output/",
               "Plan interval",
               0.,
               number(values, "End time"),
               " s",
               "fit, up to 'End time'"}};
    }
  } // namespace



  std::vector<std::string>
  unusual_values(const Values &values)
  {
    std::vector<std::string> remarks;
    for (const UsualRange &range : usual_ranges(values))
      for (const auto &[path, text_of_value] : values)
        {
          const double value = number(values, path);
          if (boost::starts_with(path, range.section) &&
              boost::ends_with(path, '/' + range.entry) && value != 0. &&
              (value < range.from || value > range.to))
            remarks.push_back(text("'",
                                   path,
                                   "' is ",
                                   value,
                                   range.unit,
                                   ", where ",
                                   range.from,
                                   " to ",
                                   range.to,
                                   range.unit,
                                   ' ',
                                   range.reason,
                                   ". Look at the number and its unit."));
        }
    return remarks;
  }
} // namespace talus

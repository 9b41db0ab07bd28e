// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/checkpoint/parameter_changes.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <cstdlib>
#include <iomanip>
#include <regex>
#include <sstream>
#include <vector>

namespace talus
{
  using dealii::Utilities::split_string_list;
  using dealii::Utilities::trim;

  /// deal.II's parser would need the declarations of the program that wrote the
  /// text. The text comes from print_parameters(), whose format is simple.
  std::map<std::string, std::string>
  values_by_path(const std::string &parameters)
  {
    std::map<std::string, std::string> values;
    std::vector<std::string>           sections;
    std::istringstream                 in(parameters);
    for (std::string line; std::getline(in, line);)
      {
        line = trim(line.substr(0, line.find('#')));
        if (line == "end" && !sections.empty())
          sections.pop_back();
        else if (line.rfind("subsection ", 0) == 0)
          sections.push_back(trim(line.substr(11)) + '/');
        else if (line.rfind("set ", 0) == 0)
          {
            const auto        equals = line.find('=');
            const std::string entry  = trim(line.substr(4, equals - 4));
            values[boost::algorithm::join(sections, "") + entry] =
              trim(line.substr(equals + 1));
          }
      }
    return values;
  }



  namespace
  {
    using Values = std::map<std::string, std::string>;



    /// Whether the state of the run is independent of a parameter. Harmless
    /// parameters are listed by name: a new parameter is relevant until added
    /// here.
    bool
    is_harmless(const std::string &path)
    {
      // A table cannot change its columns, nor begin in the middle of a run.
      if (path == "Output/Runout" || path == "Output/Plan interval")
        return false;
      // A run may continue to a later time and to more points.
      for (const std::string name : {"Title",
                                     "End time",
                                     "End when at rest",
                                     "Splitting/Maximum number of points"})
        if (path == name)
          return true;
      for (const std::string section :
           {"Output/", "Checkpoint/", "Load balance/"})
        if (path.rfind(section, 0) == 0)
          return true;
      return false;
    }



    /// Normal form of a value for comparison: 1e-3 equals 0.001, and blanks
    /// around separators are ignored.
    std::string
    normal_form(const std::string &value)
    {
      static const std::regex separator(" *[;|] *");
      std::string             result;
      for (const std::string &item :
           split_string_list(std::regex_replace(value, separator, ","), ','))
        {
          char        *end       = nullptr;
          const double number    = std::strtod(item.c_str(), &end);
          const bool   is_number = !item.empty() && *end == '\0';
          result += is_number ? text(std::setprecision(17), number) : item;
          result += ',';
        }
      return result;
    }



    /// Whether the only difference is an added stage 'dynamics' at the end.
    /// (Strength reduction cannot be added: it needs an additional column of
    /// the points.)
    bool
    adds_dynamics(const std::string &path,
                  const std::string &before,
                  const std::string &after)
    {
      return path == "Stages" &&
             normal_form(after) == normal_form(before) + "dynamics,";
    }



    /// Value for the message: "no value" for an entry that another version did
    /// not have.
    std::string
    value_of(const Values &values, const std::string &path)
    {
      const auto value = values.find(path);
      return value == values.end() ? "no value" : value->second;
    }
  } // namespace



  /// Parameters in only one of the two texts count as different. They are
  /// compared last: they usually follow from another parameter, as the
  /// parameters of a law from its name, and the message should name the
  /// parameter changed by the user. Parameters that affect the state must not
  /// change, otherwise the result would match neither parameter file.
  void
  check_parameter_changes(const std::string &saved, const std::string &now)
  {
    const Values             saved_values = values_by_path(saved);
    const Values             values       = values_by_path(now);
    std::vector<std::string> of_both, of_one;
    for (const auto &[path, value] : values)
      (saved_values.count(path) > 0 ? of_both : of_one).push_back(path);
    for (const auto &[path, value] : saved_values)
      if (values.count(path) == 0)
        of_one.push_back(path);
    of_both.insert(of_both.end(), of_one.begin(), of_one.end());
    for (const std::string &path : of_both)
      {
        const std::string before = value_of(saved_values, path);
        const std::string after  = value_of(values, path);
        AssertThrow(normal_form(before) == normal_form(after) ||
                      is_harmless(path) || adds_dynamics(path, before, after),
                    ExcUser("The parameter '" + path + "' is '" + after +
                            "', but in the run to resume it was '" + before +
                            "'. Restore the value, or start a new run in "
                            "another folder."));
      }
  }
} // namespace talus

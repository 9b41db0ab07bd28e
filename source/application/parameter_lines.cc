// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/parameter_lines.h>
#include <talus/base/errors.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/case_conv.hpp>
#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <map>
#include <sstream>

namespace talus
{
  using namespace dealii;

  std::vector<ParameterLine>
  parameter_lines(const std::string &content)
  {
    std::vector<ParameterLine> lines;
    std::istringstream         in(content);
    std::string                joined;
    unsigned int               number = 0;
    const auto                 finish = [&]() {
      const std::string text =
        Utilities::trim(joined.substr(0, joined.find('#')));
      if (!text.empty())
        lines.push_back({text, number});
      joined.clear();
    };
    bool goes_on = false;
    for (std::string line; std::getline(in, line);)
      {
        ++number;
        line    = Utilities::trim(line);
        goes_on = !line.empty() && line.back() == '\\';
        if (goes_on)
          line.pop_back();
        joined += line;
        if (!goes_on)
          finish();
      }
    if (goes_on)
      finish();
    return lines;
  }



  namespace
  {
    std::string
    place_of(const std::string &file, const ParameterLine &line)
    {
      return text(file, ", line ", line.number, ": ");
    }



    /// Return whether @p line begins with @p keyword, in small or in capital
    /// letters, as accepted by deal.II.
    bool
    begins_with(const std::string &line, const std::string &keyword)
    {
      return boost::starts_with(line, keyword) ||
             boost::starts_with(line, boost::to_upper_copy(keyword));
    }



    /// Name of the section opened by @p line; empty if none.
    std::string
    opened_section(const std::string &line)
    {
      const std::string keyword = "subsection ";
      return begins_with(line, keyword)
               ? Utilities::trim(line.substr(keyword.size()))
               : "";
    }



    bool
    closes_section(const std::string &line)
    {
      return line == "end" || line == "END";
    }



    /// Name and value of the entry set by @p line; both empty if none.
    std::pair<std::string, std::string>
    entry_of(const std::string &line)
    {
      const std::size_t equals = line.find('=');
      if (!begins_with(line, "set ") || equals == line.npos)
        return {};
      return {Utilities::trim(line.substr(4, equals - 4)),
              Utilities::trim(line.substr(equals + 1))};
    }
  } // namespace



  void
  check_line(const std::string &place, const std::string &line)
  {
    const auto control =
      std::find_if(line.begin(), line.end(), [](const unsigned char c) {
        return (c < ' ' && c != '\t') || c == 127;
      });
    AssertThrow(control == line.end(),
                ExcUser(text(place,
                             "a control character (number ",
                             static_cast<int>(*control),
                             ") was found after '",
                             line.substr(0, control - line.begin()),
                             "', where text was expected. Remove the "
                             "character.")));
    AssertThrow(!begins_with(line, "end") || closes_section(line),
                ExcUser(
                  text(place,
                       "'",
                       line,
                       "' was found, where 'end' alone was expected. Start "
                       "a comment with #.")));
    const auto [name, value] = entry_of(line);
    AssertThrow(!begins_with(line, "set ") || line.find('=') != line.npos,
                ExcUser(text(place,
                             "'",
                             line,
                             "' was found, where 'set Entry = value' was "
                             "expected. Add the '='.")));
    AssertThrow(value.find('{') == value.npos,
                ExcUser(
                  text(place,
                       "'",
                       name,
                       "' is '",
                       value,
                       "', where a value without '{' was expected. If the "
                       "line is of a template, fill in the value.")));
  }



  void
  check_lines(const std::string &file, const std::vector<ParameterLine> &lines)
  {
    std::vector<ParameterLine> open;
    for (const ParameterLine &line : lines)
      {
        check_line(place_of(file, line), line.text);
        if (!opened_section(line.text).empty())
          open.push_back(line);
        else if (closes_section(line.text))
          {
            AssertThrow(!open.empty(),
                        ExcUser(place_of(file, line) +
                                "'end' was found, where no 'subsection' is "
                                "open. Remove 'end', or add the missing "
                                "'subsection'."));
            open.pop_back();
          }
      }
    AssertThrow(open.empty(),
                ExcUser(text(place_of(file, open.back()),
                             "'",
                             open.back().text,
                             "' was found, but the file ends before a closing "
                             "'end'. Close each 'subsection' with its own "
                             "'end'.")));
  }



  std::vector<std::string>
  entries_set_twice(const std::string                &file,
                    const std::vector<ParameterLine> &lines)
  {
    std::vector<std::string>            remarks, sections;
    std::map<std::string, unsigned int> first_lines; // by path
    for (const ParameterLine &line : lines)
      if (const std::string section = opened_section(line.text);
          !section.empty())
        sections.push_back(section + "/");
      else if (closes_section(line.text))
        sections.pop_back();
      else if (const std::string entry = entry_of(line.text).first;
               !entry.empty())
        {
          const std::string path = boost::algorithm::join(sections, "") + entry;
          const auto [first, is_new] = first_lines.emplace(path, line.number);
          if (!is_new)
            remarks.push_back(text(place_of(file, line),
                                   "'",
                                   path,
                                   "' is set again, after line ",
                                   first->second,
                                   ". The last value counts. Remove one of the "
                                   "two lines."));
        }
    return remarks;
  }
} // namespace talus

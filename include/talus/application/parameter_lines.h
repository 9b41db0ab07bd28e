// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_parameter_lines_h
#define talus_application_parameter_lines_h

#include <string>
#include <vector>

namespace talus
{
  /// A line of a parameter file as deal.II's parser takes it: joined with the
  /// lines before it that end with a backslash, without comment, without blanks
  /// at its ends.
  struct ParameterLine
  {
    std::string  text;
    unsigned int number; ///< in the file, from 1; of the last joined line
  };



  /// Return the lines of a parameter file that are not empty.
  std::vector<ParameterLine>
  parameter_lines(const std::string &content);

  /// Throw ExcUser, which begins with @p place, if deal.II's parser would
  /// misread the line: `{` in a value, which it takes for a list of variants and
  /// then ignores the value; an entry without `=`; words behind `end`; control
  /// characters.
  void
  check_line(const std::string &place, const std::string &line);

  /// Throw ExcUser at the first of the lines of @p file that check_line() refuses,
  /// or that opens or closes a section without its counterpart.
  void
  check_lines(const std::string &file, const std::vector<ParameterLine> &lines);

  /// Return a remark for each entry that the lines of @p file set twice.
  std::vector<std::string>
  entries_set_twice(const std::string                &file,
                    const std::vector<ParameterLine> &lines);
} // namespace talus

#endif

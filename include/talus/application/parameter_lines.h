// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_parameter_lines_h
#define talus_application_parameter_lines_h

#include <string>
#include <vector>

namespace talus
{
  /// Logical line of a parameter file, as read by deal.II's parser: joined with
  /// previous lines that end with a backslash, without comment and trimmed.
  struct ParameterLine
  {
    std::string  text;
    unsigned int number; ///< one-based, of the last line joined
  };



  /// Return the lines of a parameter file that are not empty.
  std::vector<ParameterLine>
  parameter_lines(const std::string &content);

  /// Throw ExcUser with a message that begins with @p place if deal.II's parser
  /// would misread the line: `{` in a value, which starts a list of variants
  /// and makes the parser ignore the value; an entry without `=`; words behind
  /// `end`; control characters.
  void
  check_line(const std::string &place, const std::string &line);

  /// Throw ExcUser at the first line of @p file that check_line() refuses or
  /// that opens or closes a section without its counterpart.
  void
  check_lines(const std::string &file, const std::vector<ParameterLine> &lines);

  /// Return a remark for each entry set twice by the lines of @p file.
  std::vector<std::string>
  entries_set_twice(const std::string                &file,
                    const std::vector<ParameterLine> &lines);
} // namespace talus

#endif

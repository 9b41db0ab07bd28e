// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/checksum.h>
#include <talus/io/files.h>
#include <talus/io/text_file.h>
#include <talus/problem/time_table.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Stands for the time among the numbers of known columns.
    const unsigned int column_of_time = numbers::invalid_unsigned_int;



    /// Return the whole file, byte by byte, since the checksum belongs to the
    /// state.
    std::string
    read_file(const std::filesystem::path &file)
    {
      const auto content = read_text_file(file);
      AssertThrow(content.has_value() && !content->empty(),
                  ExcUser("The table '" + file.string() +
                          "' cannot be read or is empty. Give the path of an "
                          "existing CSV file, from the folder of the parameter "
                          "file."));
      protect_input(file);
      return *content;
    }



    /// Return the parts between commas, trimmed, including empty parts. The
    /// comma appended to the line makes an empty last entry visible.
    std::vector<std::string>
    split_at_commas(const std::string &line)
    {
      std::vector<std::string> parts;
      std::istringstream       in(line + ',');
      for (std::string part; std::getline(in, part, ',');)
        parts.push_back(Utilities::trim(part));
      return parts;
    }
  } // namespace



  /// CSV as written by spreadsheets and scripts: comments with #, empty lines,
  /// blanks, the byte order mark of UTF-8 and line ends of Windows are skipped;
  /// everything else without a number is an error with the number of the line.
  /// At least two rows, for interpolation.
  TimeTable::TimeTable(const std::filesystem::path               &file,
                       const std::vector<std::string>            &known_columns,
                       const std::pair<std::string, std::string> &abscissa)
    : name_(abscissa.first)
    , unit_(abscissa.second)
    , values_(known_columns.size())
  {
    const std::string content = read_file(file);
    checksum_                 = text(talus::checksum(content));
    std::istringstream in(content);
    unsigned int       number = 0;
    for (std::string line; std::getline(in, line);)
      {
        ++number;
        line = Utilities::trim(line);
        if (line.empty() || line[0] == '#')
          continue;
        const std::string place =
          text("The table '", file.string(), "', line ", number, ": ");
        if (known_of_read_.empty())
          read_header(line, place, known_columns);
        else
          read_row(line, place);
      }
    AssertThrow(times_.size() >= 2,
                ExcUser(text("The table '",
                             file.string(),
                             "' has ",
                             times_.size(),
                             " rows of numbers, but at least two are needed to "
                             "interpolate between. Add rows.")));
  }



  /// Columns may come in any order. For each column of the file known_of_read_
  /// has the number among the known columns. An unknown name is an error: a
  /// misspelt column would otherwise be ignored silently.
  void
  TimeTable::read_header(const std::string              &line,
                         const std::string              &place,
                         const std::vector<std::string> &known_columns)
  {
    const std::string time_name = column_name();
    std::string       expected  = "'" + time_name + "'";
    for (const std::string &name : known_columns)
      expected += ", '" + name + "'";
    for (const std::string &name : split_at_commas(line))
      {
        const auto known =
          std::find(known_columns.begin(), known_columns.end(), name);
        AssertThrow(name == time_name || known != known_columns.end(),
                    ExcUser(place + "there is a column '" + name +
                            "', but the header may name only: " + expected +
                            ". Correct the name or remove the column."));
        const unsigned int column =
          (name == time_name) ? column_of_time : known - known_columns.begin();
        AssertThrow(std::find(known_of_read_.begin(),
                              known_of_read_.end(),
                              column) == known_of_read_.end(),
                    ExcUser(place + "the column '" + name +
                            "' is there twice. Remove one of the two."));
        known_of_read_.push_back(column);
      }
    AssertThrow(known_of_read_.size() >= 2 &&
                  std::find(known_of_read_.begin(),
                            known_of_read_.end(),
                            column_of_time) != known_of_read_.end(),
                ExcUser(place + "the header is '" + line +
                        "', where the column '" + time_name +
                        "' and at least one other were expected of: " +
                        expected + ". Name the columns in the first line."));
  }



  /// One number per column of the header. Times ascend strictly: value() never
  /// divides by zero, and no jump is hidden in two rows of equal time.
  void
  TimeTable::read_row(const std::string &line, const std::string &place)
  {
    const std::vector<std::string> entries = split_at_commas(line);
    AssertThrow(entries.size() == known_of_read_.size(),
                ExcUser(text(place,
                             "there are ",
                             entries.size(),
                             " entries, but the header names ",
                             known_of_read_.size(),
                             " columns. Give one number for each, separated by "
                             "commas.")));
    for (unsigned int i = 0; i < entries.size(); ++i)
      {
        // strtod() stops at the first invalid character; the whole entry must
        // be used.
        char        *end    = nullptr;
        const double number = std::strtod(entries[i].c_str(), &end);
        AssertThrow(!entries[i].empty() && *end == '\0' &&
                      std::isfinite(number),
                    ExcUser(place + "'" + entries[i] +
                            "' was found, where a finite number was expected. "
                            "Correct it."));
        if (known_of_read_[i] != column_of_time)
          {
            values_[known_of_read_[i]].push_back(number);
            continue;
          }
        AssertThrow(times_.empty() || number > times_.back(),
                    ExcUser(text(place,
                                 "the ",
                                 name_,
                                 " is ",
                                 number,
                                 " ",
                                 unit_,
                                 ", but that of the row before is ",
                                 times_.back(),
                                 " ",
                                 unit_,
                                 ". They must ascend: sort the rows, and give "
                                 "a jump two rows some way apart.")));
        times_.push_back(number);
      }
  }



  /// Linear between the rows, constant outside. By bisection, because a record
  /// has thousands of rows and each step needs a value.
  double
  TimeTable::value(const unsigned int column, const double t) const
  {
    const std::vector<double> &values = values_[column];
    if (t <= times_.front())
      return values.front();
    if (t >= times_.back())
      return values.back();
    const unsigned int i =
      std::upper_bound(times_.begin(), times_.end(), t) - times_.begin();
    return values[i - 1] + (values[i] - values[i - 1]) * (t - times_[i - 1]) /
                             (times_[i] - times_[i - 1]);
  }
} // namespace talus

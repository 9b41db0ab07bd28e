// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_time_table_h
#define talus_problem_time_table_h

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Quantities as functions of time, given by the rows of a CSV file. The
  /// first line names the columns with units: `time [s]` and some of the known
  /// columns, in any order. Empty lines and lines beginning with # are ignored.
  /// Values are linear in time between the rows. The abscissa may be another
  /// quantity, for instance the depth.
  class TimeTable
  {
  public:
    /// Read the file. Throws ExcUser, with file and line, if it cannot be read,
    /// if a column is missing, unknown or repeated, if an entry is not a finite
    /// number, if times do not ascend, or if there are less than two rows.
    /// @param abscissa name and unit of the abscissa
    TimeTable(const std::filesystem::path               &file,
              const std::vector<std::string>            &known_columns,
              const std::pair<std::string, std::string> &abscissa = {"time",
                                                                     "s"});

    /// Return whether the file has the known column @p column.
    bool
    has(const unsigned int column) const
    {
      return !values_[column].empty();
    }

    double
    first_time() const
    {
      return times_.front();
    }

    double
    last_time() const
    {
      return times_.back();
    }

    /// Return the value at time @p t, s; constant before the first and after
    /// the last row.
    double
    value(unsigned int column, double t) const;

    /// Checksum of the content of the file.
    const std::string &
    checksum() const
    {
      return checksum_;
    }

  private:
    std::string
    column_name() const
    {
      return name_ + " [" + unit_ + "]";
    }
    void
    read_header(const std::string              &line,
                const std::string              &place,
                const std::vector<std::string> &known_columns);
    void
    read_row(const std::string &line, const std::string &place);

    std::string name_, unit_;                        ///< name and unit of the
                                                     ///< abscissa
    std::vector<double>              times_;         ///< s
    std::vector<std::vector<double>> values_;        ///< by known column
    std::vector<unsigned int>        known_of_read_; ///< invalid: the time
    std::string                      checksum_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_time_table_h
#define talus_problem_time_table_h

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Quantities as functions of time, given by the rows of a CSV file. Its first
  /// line names the columns, each with its unit: `time [s]` and some of those
  /// that the reader knows, in any order. Empty lines and those that begin with
  /// # do not count. Between the rows the values are linear in time. In the place
  /// of the time there may be another quantity, as the depth.
  class TimeTable
  {
  public:
    /// Read the file. Throws ExcUser, naming file and line, if it cannot be
    /// read, if a column is missing, unknown or there twice, if an entry is not
    /// a finite number, if times do not ascend, or if there are less than two
    /// rows.
    /// @p abscissa is what values are functions of: its name, and its unit.
    TimeTable(const std::filesystem::path               &file,
              const std::vector<std::string>            &known_columns,
              const std::pair<std::string, std::string> &abscissa = {"time",
                                                                     "s"});

    /// True if the file has column @p column of those that are known.
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

    /// Value at time @p t, s; before the first and after the last row as there.
    double
    value(unsigned int column, double t) const;

    /// Checksum of the file's content.
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

    std::string                      name_, unit_;   ///< of the abscissa
    std::vector<double>              times_;         ///< s
    std::vector<std::vector<double>> values_;        ///< by known column
    std::vector<unsigned int>        known_of_read_; ///< invalid: the time
    std::string                      checksum_;
  };
} // namespace talus

#endif

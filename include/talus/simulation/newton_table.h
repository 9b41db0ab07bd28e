// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_newton_table_h
#define talus_simulation_newton_table_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/io/files.h>

#include <cstdint>
#include <filesystem>

namespace talus
{
  /// Table newton.csv: one row per iteration of Newton's method.
  class NewtonTable
  {
  public:
    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Return the reason why a resumed run cannot continue the table, see
    /// CsvFile.
    std::string
    cannot_resume(const std::filesystem::path &folder) const;

    /// Append a row for an iteration.
    ///
    /// @param stage number, from 1
    /// @param factor by which strengths are divided [-]
    /// @param progress of the search
    void
    add(unsigned int stage, double factor, const EquilibriumProgress &progress);

    /// Length of the file, bytes.
    std::uintmax_t
    length() const;

    /// Truncate the file to @p length, bytes.
    void
    cut(std::uintmax_t length);

    CsvFile &
    file()
    {
      return file_;
    }

    static constexpr const char *file_name = "newton.csv";

  private:
    CsvFile               file_;
    std::filesystem::path folder_;
  };
} // namespace talus

#endif

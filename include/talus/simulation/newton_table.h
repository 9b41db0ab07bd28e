// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_newton_table_h
#define talus_simulation_newton_table_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/io/files.h>

#include <cstdint>
#include <filesystem>

namespace talus
{
  /// newton.csv: one row for each iteration of Newton's method.
  class NewtonTable
  {
  public:
    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Why a run cannot go on with the table, see CsvFile.
    std::string
    cannot_resume(const std::filesystem::path &folder) const;

    void
    add(unsigned int stage, double factor, const EquilibriumProgress &progress);

    /// Length of the file, B.
    std::uintmax_t
    length() const;

    /// Remove all rows beyond @p length, B.
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

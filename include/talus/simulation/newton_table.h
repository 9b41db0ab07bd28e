// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_newton_table_h
#define talus_simulation_newton_table_h

#include <talus/equilibrium/equilibrium.h>
#include <talus/io/files.h>
#include <talus/io/log.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace talus
{
  /// Description of a search for newton.csv and log.
  struct SearchLabel
  {
    unsigned int stage;           ///< one-based number of the stage
    double       strength_factor; ///< factor that divides strengths [-]
    /// Whether the search starts from a balance, with other strengths or loads.
    /// Load steps are then written to newton.csv only.
    bool is_trial = false;
  };



  /// Report of the load steps: table newton.csv with one row per iteration of
  /// Newton's method, and one line of the log per load step.
  class NewtonTable
  {
  public:
    explicit NewtonTable(Log &log)
      : log_(log)
    {}

    void
    begin(const std::filesystem::path &folder, Beginning beginning);

    /// Return the reason why a resumed run cannot continue the table, see
    /// CsvFile.
    std::string
    cannot_resume(const std::filesystem::path &folder) const;

    /// Append a row for an iteration, on the first rank, and collect the
    /// iterations of the last attempt of a load step.
    void
    add(const SearchLabel         &label,
        const EquilibriumProgress &progress,
        bool                       is_first_rank);

    /// Write a line on the load step to the log, unless there was none or the
    /// search is a trial. A new load step begins.
    void
    end_step(const SearchLabel &label);

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
    Log                  &log_;
    CsvFile               file_;
    std::filesystem::path folder_;

    // Load step
    EquilibriumProgress last_;
    std::vector<double> residuals_;
    unsigned int        n_linear_iterations_ = 0;
    double              seconds_             = 0;
  };
} // namespace talus

#endif

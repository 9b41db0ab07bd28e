// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_verification_h
#define talus_tests_cases_verification_h

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace talus::cases
{
  /// A gate that is known not to be met: why, and the value at which it would
  /// have become worse, which fails the test. In the table it "falls short".
  struct Shortfall
  {
    double      ceiling;
    std::string cause;
  };



  /// What one test holds against closed forms and invariants: each gate is
  /// asserted and becomes a row of doc/verification.md.
  class Verification
  {
  public:
    /// @p name of the case, @p run that can be repeated by hand, and the
    /// @p source of the reference. One object in a test.
    Verification(const std::string &name,
                 const std::string &run,
                 const std::string &source);

    /// @p value <= @p limit; @p reference is what it would be at best.
    void
    at_most(const std::string &quantity,
            double             value,
            double             limit,
            const std::string &reference = "0");

    void
    at_least(const std::string &quantity,
             double             value,
             double             limit,
             const std::string &reference);

    /// |value - reference| <= tolerance |reference|.
    void
    near(const std::string &quantity,
         double             value,
         double             reference,
         double             tolerance);

    /// A gate that is known not to be met.
    void
    falls_short(const std::string &quantity,
                double             value,
                double             limit,
                const Shortfall   &shortfall,
                const std::string &reference = "0");

    /// What holds or does not.
    void
    holds(const std::string &quantity,
          const std::string &value,
          const std::string &reference,
          bool               verdict);

    /// Columns for a picture of the report, in the file @p name.csv.
    static void
    write_series(
      const std::string                                              &name,
      const std::vector<std::pair<std::string, std::vector<double>>> &columns);

  private:
    void
    add_row(const std::string &quantity,
            const std::string &value,
            const std::string &reference,
            const std::string &gate,
            const std::string &verdict,
            const std::string &cause = "");

    std::string           name_, run_, source_;
    std::filesystem::path file_;
  };



  /// Errors on meshes of ever smaller cells.
  class Refinement
  {
  public:
    /// @p what is refined, for the terminal and for the series of that name.
    explicit Refinement(const std::string &what)
      : what_(what)
    {}

    void
    add(const double cells, const double error)
    {
      cells_.push_back(cells);
      errors_.push_back(error);
    }

    const std::vector<double> &
    errors() const
    {
      return errors_;
    }

    /// Print deal.II's table of convergence and write the series.
    void
    print() const;

    /// Least of the orders between successive meshes.
    double
    least_order() const;

    /// The errors as a list, for the table.
    std::string
    list() const;

  private:
    std::string         what_;
    std::vector<double> cells_, errors_;
  };
} // namespace talus::cases

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "verification.h"

#include <talus/base/errors.h>

#include <deal.II/base/convergence_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

namespace talus::cases
{
  namespace
  {
    const std::filesystem::path folder =
      std::filesystem::path(TALUS_RESULTS_DIR) / "verification";

    std::string
    short_number(const double value)
    {
      std::ostringstream out;
      out << std::setprecision(4) << value;
      return out.str();
    }



    std::string
    quoted(const std::string &field)
    {
      std::string result = "\"";
      for (const char c : field)
        result += (c == '"' ? std::string("\"\"") : std::string(1, c));
      return result + "\"";
    }
  } // namespace



  Verification::Verification(const std::string &name,
                             const std::string &run,
                             const std::string &source)
    : name_(name)
    , run_(run)
    , source_(source)
  {
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    file_ = folder / (text(test->test_suite_name(), '.', test->name(), ".csv"));
    // A test may have several tables: the first one begins the file.
    static std::set<std::filesystem::path> begun;
    if (!begun.insert(file_).second)
      return;
    std::filesystem::create_directories(folder);
    std::ofstream(file_)
      << "case,run,source,quantity,talus,reference,gate,verdict,cause\n";
  }



  void
  Verification::add_row(const std::string &quantity,
                        const std::string &value,
                        const std::string &reference,
                        const std::string &gate,
                        const std::string &verdict,
                        const std::string &cause)
  {
    std::ofstream file(file_, std::ios::app);
    for (const auto &field :
         {name_, run_, source_, quantity, value, reference, gate, verdict})
      file << quoted(field) << ',';
    file << quoted(cause) << '\n';
    std::cout << name_ << ": " << quantity << ": " << value << " (reference "
              << reference << ", gate " << gate << "): " << verdict
              << std::endl;
  }



  void
  Verification::at_most(const std::string &quantity,
                        const double       value,
                        const double       limit,
                        const std::string &reference)
  {
    EXPECT_LE(value, limit) << quantity;
    add_row(quantity,
            short_number(value),
            reference,
            "<= " + short_number(limit),
            value <= limit ? "pass" : "FAIL");
  }



  void
  Verification::at_least(const std::string &quantity,
                         const double       value,
                         const double       limit,
                         const std::string &reference)
  {
    EXPECT_GE(value, limit) << quantity;
    add_row(quantity,
            short_number(value),
            reference,
            ">= " + short_number(limit),
            value >= limit ? "pass" : "FAIL");
  }



  void
  Verification::near(const std::string &quantity,
                     const double       value,
                     const double       reference,
                     const double       tolerance)
  {
    const double error = std::abs(value - reference) / std::abs(reference);
    EXPECT_LE(error, tolerance) << quantity;
    std::ostringstream precise;
    precise << std::setprecision(6) << value << " (" << std::setprecision(2)
            << 100. * error << " % off)";
    add_row(quantity,
            precise.str(),
            text(reference),
            "within " + short_number(100. * tolerance) + " %",
            error <= tolerance ? "pass" : "FAIL");
  }



  void
  Verification::falls_short(const std::string &quantity,
                            const double       value,
                            const double       limit,
                            const Shortfall   &shortfall,
                            const std::string &reference)
  {
    EXPECT_GT(value, limit) << quantity << " meets its gate now: use at_most()";
    EXPECT_LE(value, shortfall.ceiling) << quantity;
    add_row(quantity,
            short_number(value),
            reference,
            "<= " + short_number(limit),
            value <= shortfall.ceiling ? "falls short" : "FAIL",
            shortfall.cause);
  }



  void
  Verification::holds(const std::string &quantity,
                      const std::string &value,
                      const std::string &reference,
                      const bool         verdict)
  {
    EXPECT_TRUE(verdict) << quantity;
    add_row(quantity, value, reference, reference, verdict ? "pass" : "FAIL");
  }



  void
  Verification::write_series(
    const std::string                                              &name,
    const std::vector<std::pair<std::string, std::vector<double>>> &columns)
  {
    std::filesystem::create_directories(folder / "series");
    std::ofstream file(folder / "series" / (name + ".csv"));
    file << std::setprecision(10);
    for (std::size_t c = 0; c < columns.size(); ++c)
      file << (c == 0 ? "" : ",") << columns[c].first;
    file << '\n';
    for (std::size_t row = 0; row < columns[0].second.size(); ++row)
      for (std::size_t c = 0; c < columns.size(); ++c)
        file << columns[c].second.at(row)
             << (c + 1 == columns.size() ? '\n' : ',');
  }



  void
  Refinement::print() const
  {
    dealii::ConvergenceTable table;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      {
        table.add_value("cells", cells_[i]);
        table.add_value("error", errors_[i]);
      }
    table.set_scientific("error", true);
    table.evaluate_convergence_rates(
      "error", dealii::ConvergenceTable::reduction_rate_log2);
    std::cout << what_ << ":\n";
    table.write_text(std::cout);
    Verification::write_series("convergence-" + what_,
                               {{"cells", cells_}, {"error", errors_}});
  }



  double
  Refinement::least_order() const
  {
    double least = 1e300;
    for (std::size_t i = 1; i < errors_.size(); ++i)
      least = std::min(least,
                       std::log2(errors_[i - 1] / errors_[i]) /
                         std::log2(cells_[i] / cells_[i - 1]));
    return least;
  }



  std::string
  Refinement::list() const
  {
    std::string result;
    for (const double error : errors_)
      result += (result.empty() ? "" : ", ") + short_number(error);
    return result;
  }
} // namespace talus::cases

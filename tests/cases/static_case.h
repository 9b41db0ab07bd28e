// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_static_case_h
#define talus_tests_cases_static_case_h

#include "case.h"
#include "verification.h"

#include <filesystem>
#include <string>
#include <vector>

namespace talus::cases
{
  /// A case that has been run to its end in the folder @p name, with the table
  /// of Newton's method.
  template <int dim>
  class StaticCase
  {
  public:
    StaticCase(const std::string &file,
               const std::string &name,
               const Overrides   &overrides);

    const Simulation<dim> &
    operator*() const
    {
      return simulation_;
    }

    const Points<dim> &
    points() const
    {
      return points_;
    }

    const std::filesystem::path &
    folder() const
    {
      return folder_;
    }

    /// Middle of the bracket of the factor of safety.
    double
    factor_of_safety() const;

    /// newton.csv
    const Table &
    newton() const
    {
      return newton_;
    }

  private:
    std::filesystem::path  folder_;
    Case<dim>              case_;
    const Simulation<dim> &simulation_;
    const Points<dim>     &points_;
    Table                  newton_;
  };
} // namespace talus::cases

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_column_h
#define talus_tests_cases_column_h

#include "case.h"

/// The column of prm/verification/self-weight-column.prm.
namespace talus::cases
{
  constexpr double column_length = 50., column_weight = 80. * 10.; // m, N/m^3

  /// The column at rest, from the bottom up.
  struct ColumnAtRest
  {
    std::vector<double> Y;                // m, where the points were
    std::vector<double> talus;            // kPa, the stress that they bear
    std::vector<double> closed_form;      // kPa
    double              stress_error = 0; // of rho0 g l0, mean of the points
    double              height       = 0; // m
  };

  /// One cell wide, with @p n cells over the undeformed height.
  Overrides
  column_of(unsigned int n);

  ColumnAtRest
  measure_column(const State<2> &state);

  /// Height at rest of each law, m.
  std::vector<std::pair<std::string, double>>
  column_heights();
} // namespace talus::cases

#endif

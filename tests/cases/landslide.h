// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_landslide_h
#define talus_tests_cases_landslide_h

#include "case.h"
#include "verification.h"

/// What must hold for the landslide of the paper, whatever the method.

namespace talus::cases
{
  /// g sin(5 degrees), m/s^2.
  double
  gravity_along();

  /// P_x = M g t sin + impulse of the seabed, to 1e-8 of M g t sin.
  void
  expect_momentum(Verification &gates, const Table &table);

  /// The energy budget closes to @p share of the final gravity work in every
  /// row, to 0.5 % of the work so far from 2 s on, and creates no more than
  /// @p gain of the final work.
  void
  expect_energy(Verification &gates,
                const Table  &table,
                double        share,
                double        gain);

  /// One body without holes in every row.
  void
  expect_continuum(Verification &gates, const Table &table);

  /// Time at which the kinetic energy of the grid is below 0.1 % of its maximum
  /// for the first time after that, s; infinity if never.
  double
  time_of_rest(const Table &table);

  /// The seabed carries the weight over the last 3 s, and the height is that of
  /// a layer below the one that would yield.
  void
  expect_rest(Verification &gates, const Table &table);

  /// All of the above, as it holds with splitting, and the conservation of
  /// splits.
  void
  expect_split_landslide(Verification &gates, const Table &table, double share);

  /// Empty cells in every row from 10 s on, @p least or more in most of them.
  void
  expect_fracture(Verification &gates, const Table &table, double least);

  /// Largest relative difference of a column over the rows up to @p end, s.
  double
  relative_difference(const Table       &a,
                      const Table       &b,
                      const std::string &column,
                      double             end);
} // namespace talus::cases

#endif

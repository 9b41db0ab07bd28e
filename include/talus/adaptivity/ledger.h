// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_ledger_h
#define talus_adaptivity_ledger_h

#include <talus/base/state.h>
#include <talus/points/points.h>

#include <array>

namespace talus
{
  /// What must not change when points are split: sums of mass, momentum,
  /// kinetic and elastic energy, and mass times position, over all splits.
  template <int dim>
  class Ledger
  {
  public:
    /// Count point @p p with the factor @p sign: +1 before, -1 after.
    void
    enter(const Points<dim> &points, unsigned int p, double sign);

    /// Largest error of the entries, each relative to the sum of its absolute
    /// values [-].
    double
    relative_error() const;

    /// Add the sums to the state of the run.
    void
    list_state(StateList &list);

  private:
    static constexpr unsigned int n_entries = 3 + 2 * dim;

    std::array<double, n_entries> difference_{};
    std::array<double, n_entries> scale_{};
  };
} // namespace talus

#endif

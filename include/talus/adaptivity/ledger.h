// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_ledger_h
#define talus_adaptivity_ledger_h

#include <talus/base/state.h>
#include <talus/points/points.h>

#include <array>
#include <string>

namespace talus
{
  /// What must not change when points are split or merged: sums of mass,
  /// momentum, kinetic and elastic energy, and mass times position, over all
  /// splits or merges.
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

    /// Count kinetic energy that was taken from the points and is booked
    /// elsewhere, J.
    void
    book_kinetic_energy(const double energy)
    {
      difference_[kinetic_energy] -= energy;
    }

    /// Add the sums to the state of the run, as the @p name and what they are.
    void
    list_state(StateList &list, const std::string &name);

  private:
    static constexpr unsigned int n_entries      = 3 + 2 * dim;
    static constexpr unsigned int kinetic_energy = 2 * dim + 1;

    std::array<double, n_entries> difference_{};
    std::array<double, n_entries> scale_{};
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_conservation_check_h
#define talus_adaptivity_conservation_check_h

#include <talus/base/state_list.h>
#include <talus/points/points.h>

#include <array>
#include <string>

namespace talus
{
  /// Check that splitting or merging conserves mass, momentum, kinetic and
  /// elastic energy, and mass times position: sums over all splits or merges of
  /// a run.
  template <int dim>
  class ConservationCheck
  {
  public:
    /// Add the quantities of point @p p with the factor @p sign: +1 for a point
    /// before the change, -1 for a point after the change.
    void
    add(const Points<dim> &points, unsigned int p, double sign);

    /// Largest error of the sums, each relative to the sum of absolute values
    /// [-].
    double
    relative_error() const;

    /// Exclude from the check the kinetic energy @p energy, J, that the points
    /// lose and that the caller accounts for.
    void
    exclude_kinetic_energy(const double energy)
    {
      difference_[kinetic_energy] -= energy;
    }

    /// Add the sums to the state of the run, under names that begin with
    /// @p name.
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

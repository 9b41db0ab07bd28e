// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_pore_columns_h
#define talus_maps_pore_columns_h

#include <talus/maps/plan_columns.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Excess pore pressure of the soil in columns in plan, at a given time.
  template <int dim>
  class PoreColumns
  {
  public:
    /// Evaluate the soil of all ranks. Collective.
    void
    find(const State<dim> &state, const PlanColumns<dim> &columns);

    /// Whether the soil has an excess pore pressure.
    bool
    is_used() const
    {
      return !ratio_.empty();
    }

    /// Largest pore_pressure_ratio() in a column [-]; not a number without
    /// soil.
    double
    largest_ratio(const unsigned int column) const
    {
      return ratio_[column];
    }

    /// Pressure at the base of the soil in a column, Pa, extrapolated from the
    /// lowest cell; not a number without soil.
    double
    at_bed(const unsigned int column) const
    {
      return at_bed_[column];
    }

  private:
    std::vector<double> ratio_, at_bed_; ///< by column
  };
} // namespace talus

#endif

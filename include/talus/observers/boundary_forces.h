// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_boundary_forces_h
#define talus_observers_boundary_forces_h

#include <talus/boundaries/boundary_reactions.h>
#include <talus/observers/quantity_table.h>

namespace talus
{
  /// boundaries.csv: what the soil does to each face of the mesh that has a
  /// condition, one row per interval of the statistics, as obstacles.csv does it
  /// for obstacles.
  template <int dim>
  class BoundaryForces : public QuantityTable<dim>
  {
  public:
    /// @p reactions start a new interval with each row.
    explicit BoundaryForces(BoundaryReactions<dim> &reactions);

    /// If the parameters of the boundaries ask for it.
    bool
    is_enabled(const OutputSettings &settings) const override;

    Quantities
    evaluate(const State<dim> &state) const override;

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override;

  private:
    BoundaryReactions<dim> &reactions_;
  };
} // namespace talus

#endif

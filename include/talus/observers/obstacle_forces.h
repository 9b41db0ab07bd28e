// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_obstacle_forces_h
#define talus_observers_obstacle_forces_h

#include <talus/contact/facet_contact.h>
#include <talus/observers/quantity_table.h>

#include <vector>

namespace talus
{
  /// obstacles.csv: what the soil does to each obstacle, one row per interval of
  /// the statistics. Forces are those on the obstacle: means over all steps
  /// since the row before, and the least and largest components in any of these
  /// steps. Impulses and works are those since the start. doc/output.md lists
  /// the columns.
  template <int dim>
  class ObstacleForces : public QuantityTable<dim>
  {
  public:
    /// @p contact starts a new interval with each row.
    explicit ObstacleForces(FacetContact<dim> &contact);

    /// Where there are obstacles.
    bool
    is_enabled(const OutputSettings &settings) const override;

    void
    observe(const State<dim> &state) override;

    void
    list_state(StateList &list) override;

    Quantities
    evaluate(const State<dim> &state) const override;

  private:
    void
    list_forces(unsigned int k, Quantities &row) const;
    /// Soil below the surface of an obstacle.
    struct Penetration
    {
      double volume   = 0; ///< m^dim
      double deepest  = 0; ///< m
      double in_cells = 0; ///< the same in cells
    };

    std::vector<Penetration>
    penetrations(const State<dim> &state) const;
    void
    list_penetration(unsigned int       k,
                     const Penetration &own,
                     const State<dim>  &state,
                     Quantities        &row) const;

    FacetContact<dim> &contact_;
  };
} // namespace talus

#endif

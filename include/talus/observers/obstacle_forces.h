// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_obstacle_forces_h
#define talus_observers_obstacle_forces_h

#include <talus/contact/contact.h>
#include <talus/observers/reaction_table.h>

#include <vector>

namespace talus
{
  /// obstacles.csv: force of the soil on each obstacle, its motion, and volume
  /// and depth of soil below the surface. doc/output.md lists the columns.
  template <int dim>
  class ObstacleForces : public ReactionTable<dim>
  {
  public:
    explicit ObstacleForces(const Contact<dim> &contact)
      : ReactionTable<dim>("obstacles.csv", "obstacle")
      , contact_(contact)
    {}

    /// Whether obstacles exist.
    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return !contact_.obstacles().empty();
    }

    Quantities
    evaluate(const State<dim> &state) const override;

  private:
    const std::vector<Reaction<dim>> &
    reactions() const override
    {
      return contact_.reactions();
    }

    const std::string &
    name(const unsigned int k) const override
    {
      return contact_.obstacles()[k].name();
    }

    /// Soil below the surface of an obstacle.
    struct Penetration
    {
      double volume   = 0; ///< m^dim
      double deepest  = 0; ///< maximum depth, m
      double in_cells = 0; ///< maximum depth [cells]
    };

    std::vector<Penetration>
    penetrations(const State<dim> &state) const;
    void
    list_motion(unsigned int k, Quantities &row) const;
    void
    list_penetration(unsigned int       k,
                     const Penetration &own,
                     const State<dim>  &state,
                     Quantities        &row) const;

    const Contact<dim> &contact_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_boundary_forces_h
#define talus_observers_boundary_forces_h

#include <talus/boundaries/boundary_reactions.h>
#include <talus/observers/reaction_table.h>

namespace talus
{
  /// boundaries.csv: force of the soil on each face of the mesh with a
  /// condition.
  template <int dim>
  class BoundaryForces : public ReactionTable<dim>
  {
  public:
    explicit BoundaryForces(const BoundaryReactions<dim> &reactions)
      : ReactionTable<dim>("boundaries.csv", "face")
      , reactions_(reactions)
    {}

    /// Whether the parameter `Boundaries/Write forces` is set.
    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return reactions_.is_enabled();
    }

  private:
    const std::vector<Reaction<dim>> &
    reactions() const override
    {
      return reactions_.all();
    }

    const std::string &
    name(const unsigned int k) const override
    {
      return reactions_.name(k);
    }

    const BoundaryReactions<dim> &reactions_;
  };
} // namespace talus

#endif

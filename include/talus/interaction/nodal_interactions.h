// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_interaction_nodal_interactions_h
#define talus_interaction_nodal_interactions_h

#include <talus/interaction/nodal_interaction.h>

#include <memory>
#include <utility>
#include <vector>

namespace talus
{
  /// Nodal interactions of a run in their order of precedence.
  ///
  /// Velocities are corrected and energies recorded from the last interaction
  /// to the first. The first interaction decides: nothing passes a wall,
  /// whatever obstacles and damping did before. All other members go from the
  /// first to the last. Forces add up in any order.
  template <int dim>
  class NodalInteractions
  {
  public:
    /// Append an interaction of type @p Interaction made from @p arguments.
    /// Return a reference, valid for the lifetime of the list.
    template <typename Interaction, typename... Arguments>
    Interaction &
    add(Arguments &&...arguments)
    {
      auto interaction =
        std::make_unique<Interaction>(std::forward<Arguments>(arguments)...);
      Interaction &result = *interaction;
      list_.push_back(std::move(interaction));
      return result;
    }

    void
    open_accounts(Accounts<dim> &accounts)
    {
      for (const auto &interaction : list_)
        interaction->open_accounts(accounts);
    }
    void
    prepare(const Grid<dim> &grid)
    {
      for (const auto &interaction : list_)
        interaction->prepare(grid);
    }
    void
    begin_step(State<dim> &state)
    {
      for (const auto &interaction : list_)
        interaction->begin_step(state);
    }
    void
    add_forces(State<dim> &state)
    {
      for (const auto &interaction : list_)
        interaction->add_forces(state);
    }
    void
    correct_velocities(State<dim> &state)
    {
      for (auto it = list_.rbegin(); it != list_.rend(); ++it)
        (*it)->correct_velocities(state);
    }
    void
    record(State<dim> &state)
    {
      for (auto it = list_.rbegin(); it != list_.rend(); ++it)
        (*it)->record(state);
    }
    void
    list_quantities(const State<dim> &state, Quantities &list) const
    {
      for (const auto &interaction : list_)
        interaction->list_quantities(state, list);
    }
    void
    list_state(StateList &list)
    {
      for (const auto &interaction : list_)
        interaction->list_state(list);
    }
    std::vector<std::string>
    notes() const
    {
      std::vector<std::string> result;
      for (const auto &interaction : list_)
        {
          const std::vector<std::string> notes = interaction->notes();
          result.insert(result.end(), notes.begin(), notes.end());
        }
      return result;
    }

  private:
    std::vector<std::unique_ptr<NodalInteraction<dim>>> list_;
  };
} // namespace talus

#endif

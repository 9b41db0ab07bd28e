// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/interaction/nodal_interactions.h>

namespace talus
{
  template <int dim>
  void
  NodalInteractions<dim>::open_accounts(Accounts<dim> &accounts)
  {
    for (const auto &interaction : list_)
      interaction->open_accounts(accounts);
  }



  template <int dim>
  void
  NodalInteractions<dim>::prepare(const Grid<dim> &grid)
  {
    for (const auto &interaction : list_)
      interaction->prepare(grid);
  }



  template <int dim>
  void
  NodalInteractions<dim>::begin_step(State<dim> &state)
  {
    for (const auto &interaction : list_)
      interaction->begin_step(state);
  }



  template <int dim>
  void
  NodalInteractions<dim>::add_forces(State<dim> &state)
  {
    for (const auto &interaction : list_)
      interaction->add_forces(state);
  }



  template <int dim>
  void
  NodalInteractions<dim>::correct_velocities(State<dim> &state)
  {
    for (auto it = list_.rbegin(); it != list_.rend(); ++it)
      (*it)->correct_velocities(state);
  }



  template <int dim>
  void
  NodalInteractions<dim>::record(State<dim> &state)
  {
    for (auto it = list_.rbegin(); it != list_.rend(); ++it)
      (*it)->record(state);
  }



  template <int dim>
  void
  NodalInteractions<dim>::list_quantities(const State<dim> &state,
                                          Quantities       &list) const
  {
    for (const auto &interaction : list_)
      interaction->list_quantities(state, list);
  }



  template <int dim>
  void
  NodalInteractions<dim>::list_state(StateList &list)
  {
    for (const auto &interaction : list_)
      interaction->list_state(list);
  }



  template <int dim>
  std::vector<std::string>
  NodalInteractions<dim>::notes() const
  {
    std::vector<std::string> result;
    for (const auto &interaction : list_)
      {
        const std::vector<std::string> notes = interaction->notes();
        result.insert(result.end(), notes.begin(), notes.end());
      }
    return result;
  }



  template class NodalInteractions<2>;
  template class NodalInteractions<3>;
} // namespace talus

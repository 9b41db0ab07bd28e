// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/state/accounts.h>

#include <talus/base/assertion.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <typename List>
    auto
    find_account(List &list, const std::string &name)
    {
      return std::find_if(list.begin(), list.end(), [&](const auto &account) {
        return account.name == name;
      });
    }



    template <typename List>
    auto &
    open_account(List &list, const std::string &name)
    {
      const auto found = find_account(list, name);
      AssertThrow(found != list.end(),
                  ExcMessage("The account '" + name + "' was not opened."));
      return *found;
    }
  } // namespace



  template <int dim>
  void
  Accounts<dim>::open_energy(const std::string &name, const EnergyKind kind)
  {
    const auto found = find_account(energies_, name);
    if (found == energies_.end())
      energies_.push_back({name, kind, 0., {}});
    else
      TalusAssert(found->kind == kind,
                  ExcMessage("The account '" + name +
                             "' is open as another kind."));
  }



  template <int dim>
  void
  Accounts<dim>::open_stored_energy(const std::string             &name,
                                    const typename Energy::Stored &stored)
  {
    if (find_account(energies_, name) == energies_.end())
      energies_.push_back({name, EnergyKind::stored, 0., stored});
  }



  template <int dim>
  void
  Accounts<dim>::open_impulse(const std::string &name)
  {
    if (find_account(impulses_, name) == impulses_.end())
      impulses_.push_back({name, {}});
  }



  template <int dim>
  double &
  Accounts<dim>::energy(const std::string &name)
  {
    return open_account(energies_, name).value;
  }



  template <int dim>
  double
  Accounts<dim>::energy(const std::string &name) const
  {
    return open_account(energies_, name).value;
  }



  template <int dim>
  Tensor<1, dim> &
  Accounts<dim>::impulse(const std::string &name)
  {
    return open_account(impulses_, name).value;
  }



  template <int dim>
  const Tensor<1, dim> &
  Accounts<dim>::impulse(const std::string &name) const
  {
    return open_account(impulses_, name).value;
  }



  template <int dim>
  void
  Accounts<dim>::list_state(StateList &list)
  {
    for (Energy &energy : energies_)
      if (energy.kind != EnergyKind::stored)
        list.add(energy.name, "J", energy.value, Reduction::sum);
    for (Impulse &impulse : impulses_)
      list.add_components(
        impulse.name, "N s", impulse.value, dim, Reduction::sum);
  }



  template class Accounts<2>;
  template class Accounts<3>;
} // namespace talus

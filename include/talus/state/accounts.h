// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_state_accounts_h
#define talus_state_accounts_h

#include <talus/base/state_list.h>
#include <talus/points/points.h>

#include <deal.II/base/tensor.h>

#include <deque>
#include <functional>
#include <string>

namespace talus
{
  /// Terms of the energy budget and impulses on the soil, by name. A part of
  /// the program that exchanges energy or momentum with the soil opens an
  /// account before the run and records the amounts of every step. Tables,
  /// energy budget and checkpoints list all open accounts. All amounts are the
  /// share of this rank since the start of the run.
  template <int dim>
  class Accounts
  {
  public:
    enum class EnergyKind
    {
      supplied, ///< given to the soil so far
      taken,    ///< taken from the soil so far
      stored    ///< stored now
    };

    struct Energy
    {
      /// Energy stored by the points of this rank, J.
      using Stored = std::function<double(const Points<dim> &)>;

      std::string name; ///< heading of the column, without unit
      EnergyKind  kind;
      double      value = 0; ///< J; 0 for a stored energy
      Stored      stored;    ///< for a stored energy only
    };

    struct Impulse
    {
      std::string            name;
      dealii::Tensor<1, dim> value; ///< on the soil, N s
    };

    /// Open the account @p name at zero. All who open the same name share the
    /// account.
    void
    open_energy(const std::string &name, EnergyKind kind = EnergyKind::taken);
    void
    open_stored_energy(const std::string             &name,
                       const typename Energy::Stored &stored);
    void
    open_impulse(const std::string &name);

    /// Return the amount of an open account, J or N s, to be increased.
    double &
    energy(const std::string &name);
    double
    energy(const std::string &name) const;
    dealii::Tensor<1, dim> &
    impulse(const std::string &name);
    const dealii::Tensor<1, dim> &
    impulse(const std::string &name) const;

    /// Terms of the energy budget in the order of opening.
    const std::deque<Energy> &
    energies() const
    {
      return energies_;
    }

    /// Impulses in the order of opening.
    const std::deque<Impulse> &
    impulses() const
    {
      return impulses_;
    }

    void
    list_state(StateList &list);

  private:
    // References to elements survive push_back().
    std::deque<Energy>  energies_;
    std::deque<Impulse> impulses_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_merger_h
#define talus_adaptivity_merger_h

#include <talus/adaptivity/joint_box.h>
#include <talus/adaptivity/ledger.h>
#include <talus/adaptivity/splitter.h>
#include <talus/base/quantity.h>
#include <talus/grid/grid.h>
#include <talus/materials/materials.h>
#include <talus/points/points.h>
#include <talus/points/reordering.h>
#include <talus/state/state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  /// Makes one point of two that lie side by side in a cell: what splitting
  /// made, and soil that is compressed or has come to rest no longer needs.
  ///
  /// Two points of one body and cell are merged if their boxes together are
  /// nearly a box (JointBox::misfit()) that is no longer than `Merge length`
  /// along the axis they lie along, and that could be stretched by a quarter
  /// along every axis before it is split. Mass, volume, momentum, centre of
  /// mass and the volume integral of the stress are kept, internal variables
  /// are means by mass. The kinetic energy of the difference of the velocities
  /// is lost. The children of a split that have stayed as they were give their
  /// parent.
  ///
  /// Which points are merged depends on where they are, and not on their
  /// numbers or their order, so that all numbers of ranks merge the same.
  template <int dim>
  class Merger : public dealii::ParameterAcceptor
  {
  public:
    Merger();

    bool
    is_enabled() const
    {
      return enabled_;
    }

    /// Throw ExcUser if what is merged would be split soon.
    void
    check(const Splitter<dim> &splitter) const;

    /// Whether the step after @p step steps begins with merging.
    bool
    is_due(const unsigned long step) const
    {
      return enabled_ && step > 0 && step % interval_ == 0;
    }

    /// Open the account of the energy that merging takes from the points.
    void
    open_accounts(Accounts<dim> &accounts) const
    {
      if (enabled_)
        accounts.open_energy("merging work");
    }

    /// Merge points and record the energy lost.
    void
    apply(State<dim>           &state,
          const Splitter<dim>  &splitter,
          const Materials<dim> &materials);

    /// Merge what can be merged of the points, which are sorted, and stay so; no
    /// cell becomes empty. @p added_mass as in RunConstants. Returns
    /// the kinetic energy that was lost on this rank, J, with that of the added
    /// mass.
    double
    merge(Points<dim>               &points,
          const Grid<dim>           &grid,
          BoxRule                    rule,
          const std::vector<double> &added_mass,
          const Splitter<dim>       &splitter);

    unsigned long
    n_merges() const
    {
      return n_merges_;
    }

    /// Largest relative error of what merging must keep; see Ledger.
    double
    ledger() const
    {
      return ledger_.relative_error();
    }

    /// List what was merged so far, if anything may be. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    /// Add it to the state of the run.
    void
    list_state(StateList &list);

  private:
    bool
    fits(const JointBox<dim> &joint,
         unsigned int         axis,
         double               cell_size,
         const Splitter<dim> &splitter) const;
    double
    merge_along(unsigned int         axis,
                Points<dim>         &points,
                BoxRule              rule,
                double               cell_size,
                const Splitter<dim> &splitter);
    double
    merge_pair(Points<dim>         &points,
               BoxRule              rule,
               unsigned int         p,
               unsigned int         q,
               const JointBox<dim> &joint);

    bool         enabled_   = false;
    unsigned int interval_  = 100;
    double       length_    = 0.45;
    double       tolerance_ = 0.15;

    std::vector<unsigned int> members_; ///< of the segment at hand
    std::vector<unsigned int> removed_;
    Reordering                reordering_;
    Ledger<dim>               ledger_;
    unsigned long             n_merges_ = 0;
  };
} // namespace talus

#endif

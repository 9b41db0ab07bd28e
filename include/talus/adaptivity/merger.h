// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_merger_h
#define talus_adaptivity_merger_h

#include <talus/adaptivity/conservation_check.h>
#include <talus/adaptivity/joint_cell.h>
#include <talus/adaptivity/splitter.h>
#include <talus/base/quantity.h>
#include <talus/grid/grid.h>
#include <talus/materials/materials.h>
#include <talus/points/points.h>
#include <talus/points/reordering.h>
#include <talus/state/state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Merges pairs of points that lie side by side in a cell, where soil was
  /// split and is later compressed, sheared or comes to rest.
  ///
  /// Two points of the same body and cell of the grid are merged if their cells
  /// together are nearly a cell (JointCell::misfit()). The joint edge on which
  /// the points lie must be no longer than `Merge length`. A further stretch of
  /// any edge by 1.25 must not cause a split. By default only points that come
  /// from a split are merged. Merging keeps mass, volume, momentum, centre of
  /// mass and the volume integral of the stress; internal variables become
  /// means weighted by mass. The kinetic energy of the relative velocity is
  /// lost. Children of a split that have not changed become their parent again.
  ///
  /// The choice of pairs depends on the positions of the points and not on ids
  /// or storage order: any number of ranks merges the same pairs.
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

    /// Take the parameters over and limit the merge length, so that merged
    /// points are not split again soon. Throw ExcUser if the boxes of @p shape
    /// count shear or do not follow the cells. Without splitting merging is
    /// disabled, unless points that were never split are merged.
    void
    prepare(const Splitter<dim> &splitter, const BoxShape &shape);

    /// Return whether the step that follows @p step steps begins with merging.
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

    /// Merge all pairs that fulfil the criterion. The points must be sorted and
    /// remain sorted; no cell becomes empty.
    /// @param points Points of this rank.
    /// @param grid Background grid, prepared for the points.
    /// @param rule Rule for the boxes of the points.
    /// @param added_mass Added mass over mass, per body [-]; may be empty.
    /// @param splitter Splitter, for the lengths at which points are split.
    /// @return Kinetic energy lost on this rank, J, with the part of the added
    ///   mass.
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

    /// Largest relative error of the conserved quantities [-]; see
    /// ConservationCheck.
    double
    conservation_error() const
    {
      return conservation_.relative_error();
    }

    /// Append the number of merges and the error of conservation to @p list, if
    /// merging is enabled. Collective.
    void
    list_quantities(const State<dim> &state, Quantities &list) const;

    /// Add the number of merges and the conservation check to the state of the
    /// run.
    void
    list_state(StateList &list)
    {
      if (!enabled_)
        return;
      list.add("merges", "-", n_merges_, Reduction::sum);
      conservation_.list_state(list, "merge conservation error");
    }

  private:
    bool
    fits(const JointCell<dim> &joint,
         unsigned int          axis,
         double                cell_size,
         const Splitter<dim>  &splitter) const;
    double
    merge_along(unsigned int         axis,
                Points<dim>         &points,
                BoxRule              rule,
                double               cell_size,
                std::size_t          n_kept,
                const Splitter<dim> &splitter);
    double
    merge_pair(Points<dim>          &points,
               BoxRule               rule,
               unsigned int          p,
               unsigned int          q,
               const JointCell<dim> &joint);

    std::string  merge_     = "true";
    bool         enabled_   = true;
    unsigned int interval_  = 100;
    double       length_    = 0.5;
    double       tolerance_ = 0.15;

    /// Number of points down to which a segment is merged. All points of films
    /// in 2-D are kept, and of hyperelastic laws, as joint edges would change
    /// F, of which the stress is a function.
    std::function<std::size_t(const Segment &)> n_kept_;

    std::vector<unsigned int> members_; ///< points of the current segment
    std::vector<unsigned int> removed_;
    Reordering                reordering_;
    ConservationCheck<dim>    conservation_;
    unsigned long             n_merges_ = 0;
  };
} // namespace talus

#endif

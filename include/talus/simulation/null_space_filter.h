// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_null_space_filter_h
#define talus_simulation_null_space_filter_h

#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// Removes velocities and mean stresses of the points that are invisible to
  /// the background grid.
  ///
  /// Points outnumber nodes, so there are velocities of the points that sum to
  /// zero at every node: the null space of the transfer. FLIP never changes
  /// null-space velocities, and they accumulate: in a slide at rest points move
  /// at up to 1 m/s. At fixed intervals the filter replaces the velocities by
  /// XPIC(m), which keeps everything that m passes to the grid and back can
  /// see, and hardly damps the motion. @cite hammerquist2017 Momentum is
  /// conserved; the kinetic energy removed is part of the remainder of the
  /// energy budget.
  ///
  /// The mean stress has a null space, too: under B-bar the nodes feel only the
  /// mean over the cell, and the differences of the points from the mean
  /// accumulate as points move from cell to cell. The filter replaces the mean
  /// stress by the cell mean, which changes no nodal force. @cite alkafaji2013
  /// Laws that compute the stress from the deformation gradient restore their
  /// stress in the next step.
  template <int dim>
  class NullSpaceFilter : public dealii::ParameterAcceptor
  {
  public:
    NullSpaceFilter();

    /// Whether the filter runs at the beginning of the step after @p step
    /// steps.
    bool
    is_due(const unsigned int step) const
    {
      return scheme_ == "filtered FLIP" && step > 0 && step % interval_ == 0;
    }

    /// Filter velocity and mean stress of all points. Collective.
    ///
    /// @param workspace scratch space
    /// @param nodes scratch space; its sums are overwritten
    /// @param transfer transfer scheme of the run
    /// @param mass_cutoff see Transfer::mass_cutoff(), kg
    void
    apply(State<dim> &state, const Transfer<dim> &transfer) const;

  private:
    std::string  scheme_   = "FLIP";
    unsigned int interval_ = 100;
    unsigned int order_    = 4;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_null_space_filter_h
#define talus_simulation_null_space_filter_h

#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>

namespace talus
{
  /// Takes from the points what the background grid cannot see.
  ///
  /// Points outnumber the nodes, so that there are velocities of the points that
  /// sum to nothing at every node: the null space of the transfer. FLIP leaves
  /// them alone, and they gather: in a slide at rest points run about at up to
  /// 1 m/s. Every some steps the velocities are replaced by those of XPIC(m),
  /// which keeps all that m passes to the grid and back can see, and so hardly
  /// damps the motion. @cite hammerquist2017 Momentum is kept; the kinetic
  /// energy that is taken belongs to the remainder of the energy budget.
  ///
  /// The same for the mean stress: under B-bar the nodes feel the
  /// mean over the cell only, and what the points differ from it gathers as they
  /// wander from cell to cell. It is replaced by that mean, which changes no nodal
  /// force. @cite alkafaji2013 (Laws that compute the stress from the deformation
  /// gradient find theirs again.)
  template <int dim>
  class NullSpaceFilter : public dealii::ParameterAcceptor
  {
  public:
    NullSpaceFilter();

    /// Whether the step after @p step steps begins with the filter.
    bool
    is_due(const unsigned int step) const
    {
      return scheme_ == "filtered FLIP" && step > 0 && step % interval_ == 0;
    }

    /// Filter velocity and mean stress of all points. The nodes are left with
    /// sums of no further use. Collective.
    void
    apply(State<dim> &state, const Transfer<dim> &transfer) const;

  private:
    std::string  scheme_   = "FLIP";
    unsigned int interval_ = 100;
    unsigned int order_    = 4;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_load_balance_h
#define talus_adaptivity_load_balance_h

#include <talus/base/state.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  /// Shares the cells out among the ranks so that each has about as many
  /// points. Work is counted in points, never in seconds: runs can be repeated.
  template <int dim>
  class LoadBalance : public dealii::ParameterAcceptor
  {
  public:
    LoadBalance();

    /// Largest number of points of a rank, divided by the mean [-]; 1 if there
    /// are none. Collective.
    static double
    imbalance(const Points<dim> &points, MPI_Comm communicator);

    /// Whether the points of the ranks are to be counted after @p step steps.
    bool
    is_due(unsigned long step, MPI_Comm communicator) const;

    /// Whether the imbalance is too large, and larger than the last repartition
    /// could make it. Collective.
    bool
    is_needed(const Points<dim> &points, MPI_Comm communicator) const;

    /// Give cells, and the points in them, to other ranks, and prepare the grid
    /// anew. Returns the new cell of each point. The points must be sorted, and
    /// are not any more. Collective.
    std::vector<unsigned int>
    repartition(Grid<dim> &grid, Points<dim> &points);

    /// Weights of this rank's cells at the last repartition: what restores it.
    /// Empty if there was none, as on one rank.
    const std::vector<double> &
    weights() const
    {
      return weights_;
    }

    /// To be told after a mesh was loaded and shared out by these.
    void
    set_weights(const std::vector<double> &weights)
    {
      weights_ = weights;
    }

    /// Add what decides about the next repartition to the state of the run.
    void
    list_state(StateList &list);

  private:
    double       allowed_imbalance_ = 1.2;
    unsigned int interval_          = 50;

    /// Right after the last repartition: cells are not divided.
    double              reached_imbalance_ = 1.;
    std::vector<double> weights_;
  };
} // namespace talus

#endif

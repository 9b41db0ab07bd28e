// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_load_balance_h
#define talus_adaptivity_load_balance_h

#include <talus/base/state_list.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  /// Distributes the cells among the ranks so that all ranks have about the
  /// same number of points. Work is measured in points and not in seconds, so
  /// that runs can be repeated.
  template <int dim>
  class LoadBalance : public dealii::ParameterAcceptor
  {
  public:
    LoadBalance();

    /// Return the largest number of points of a rank, divided by the mean [-];
    /// 1 if there are no points. Collective.
    static double
    imbalance(const Points<dim> &points, MPI_Comm communicator);

    /// Return whether the points of the ranks must be counted after @p step
    /// steps.
    bool
    is_due(unsigned long step, MPI_Comm communicator) const;

    /// Return whether the imbalance exceeds both the allowed value and the
    /// value reached by the last repartition. Collective.
    bool
    is_needed(const Points<dim> &points, MPI_Comm communicator) const;

    /// Move cells with their points between ranks and prepare the grid again.
    /// The points must be sorted on entry and are unsorted on return.
    /// Collective.
    /// @return New cell of each point.
    std::vector<unsigned int>
    repartition(Grid<dim> &grid, Points<dim> &points);

    /// Weights of the cells of this rank at the last repartition, from which a
    /// resumed run repeats the partition. Empty before the first repartition
    /// and on one rank.
    const std::vector<double> &
    weights() const
    {
      return weights_;
    }

    /// Restore the weights after a mesh was loaded and partitioned by
    /// @p weights.
    void
    set_weights(const std::vector<double> &weights)
    {
      weights_ = weights;
    }

    /// Add the imbalance reached, on which the next repartition depends, to the
    /// state of the run.
    void
    list_state(StateList &list);

  private:
    double       allowed_imbalance_ = 1.2;
    unsigned int interval_          = 50;

    /// Imbalance just after the last repartition [-]. May exceed 1, as cells
    /// are indivisible.
    double              reached_imbalance_ = 1.;
    std::vector<double> weights_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_load_balance_h
#define talus_adaptivity_load_balance_h

#include <talus/base/state_list.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <algorithm>
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
    imbalance(const Points<dim> &points, const MPI_Comm communicator)
    {
      const auto n =
        dealii::Utilities::MPI::min_max_avg(points.size(), communicator);
      return n.sum > 0 ? n.max / n.avg : 1.;
    }

    /// Return whether the points of the ranks must be counted after @p step
    /// steps.
    bool
    is_due(const unsigned long step, const MPI_Comm communicator) const
    {
      // Counting needs a message between all ranks, too expensive for every
      // step.
      return dealii::Utilities::MPI::n_mpi_processes(communicator) > 1 &&
             step % interval_ == 0;
    }

    /// Return whether the imbalance exceeds both the allowed value and the
    /// value reached by the last repartition. Collective.
    bool
    is_needed(const Points<dim> &points, const MPI_Comm communicator) const
    {
      // A cell belongs to one rank as a whole, so with few cells per rank the
      // allowed imbalance may be out of reach. The second bound avoids useless
      // repartitions: only an imbalance 5 % above the value reached last is a
      // reason to try again.
      return imbalance(points, communicator) >
             std::max(allowed_imbalance_, 1.05 * reached_imbalance_);
    }

    /// Move cells with their points between ranks and prepare the grid again.
    /// The points must be sorted on entry and are unsorted on return.
    /// Collective.
    /// @return New cell of each point.
    std::vector<unsigned int>
    repartition(Grid<dim> &grid, Points<dim> &points);

    /// Do the same with given weights, one per owned cell [-], such as the
    /// weights of a checkpoint.
    std::vector<unsigned int>
    repartition(Grid<dim>                 &grid,
                Points<dim>               &points,
                const std::vector<double> &weights);

    /// Weights of the cells of this rank at the last repartition, from which a
    /// resumed run repeats the partition. Empty before the first repartition
    /// and on one rank.
    const std::vector<double> &
    weights() const
    {
      return weights_;
    }

    /// Add the imbalance reached, on which the next repartition depends, to the
    /// state of the run.
    void
    list_state(StateList &list)
    {
      list.add("reached imbalance", "-", reached_imbalance_, Reduction::equal);
    }

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

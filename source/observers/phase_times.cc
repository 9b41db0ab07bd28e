// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/observers/phase_times.h>

#include <deal.II/base/utilities.h>

#include <iomanip>
#include <sstream>

namespace talus
{
  using namespace dealii;

  std::vector<std::string>
  phase_times(const PhaseTimer &timer, const MPI_Comm communicator)
  {
    // All ranks have the same phases in the same order, as required by the sums
    // over ranks below.
    const auto phases = timer.seconds();
    double     total  = 0;
    for (const auto &phase : phases)
      total += phase.second;
    // Use means over the ranks: the shares of the means add up to 100 %.
    total = Utilities::MPI::sum(total, communicator) /
            Utilities::MPI::n_mpi_processes(communicator);

    std::vector<std::string> lines = {
      "Wall time by phase, s: least, mean and largest over the ranks, share"};
    // The difference of minimum and maximum shows whether ranks wait.
    for (const auto &[name, seconds] : phases)
      {
        const auto over_ranks =
          Utilities::MPI::min_max_avg(seconds, communicator);
        std::ostringstream line;
        line << "  " << std::left << std::setw(16) << name << std::right
             << std::fixed << std::setprecision(3) << std::setw(12)
             << over_ranks.min << std::setw(12) << over_ranks.avg
             << std::setw(12) << over_ranks.max << std::setprecision(1)
             << std::setw(8) << 100. * over_ranks.avg / total << " %";
        lines.push_back(line.str());
      }

    // VmHWM is the peak resident memory, kB.
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    const auto peak =
      Utilities::MPI::min_max_avg(memory.VmHWM / 1024., communicator);
    std::ostringstream line;
    line << std::fixed << std::setprecision(0)
         << "Peak memory of a rank, MB: least " << peak.min << ", mean "
         << peak.avg << ", largest " << peak.max;
    lines.push_back(line.str());
    return lines;
  }



  std::vector<std::string>
  work_of_ranks(const PhaseTimer &timer,
                const Progress   &progress,
                const SentByRank &sent,
                const MPI_Comm    communicator)
  {
    const auto sum = [communicator](const double x) {
      return Utilities::MPI::sum(x, communicator);
    };
    double seconds = 0;
    for (const auto &phase : timer.seconds())
      seconds += phase.second;
    const auto points =
      Utilities::MPI::min_max_avg(progress.n_point_steps(), communicator);
    const double n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    // Sums over the ranks first: all ranks take part.
    const double n_rank_steps = n_ranks * progress.n_steps();
    const double messages = sum(sent.n_messages), bytes = sum(sent.n_bytes),
                 nodes     = sum(sent.n_nodes),
                 with_soil = sum(sent.n_nodes_with_soil);
    // A resumed run may have nothing left to do.
    if (!(points.sum > 0.))
      return {};
    std::vector<std::string> lines = {
      text("Work: ",
           std::setprecision(4),
           points.sum,
           " point-steps of ",
           1e9 * sum(seconds) / points.sum,
           " ns of a rank; largest share of a rank over the mean ",
           points.max / points.avg)};
    if (n_ranks > 1)
      lines.push_back(text("Messages of nodes: ",
                           std::setprecision(4),
                           messages / n_rank_steps,
                           " of a rank per step, together ",
                           1e-3 * bytes / n_rank_steps,
                           " kB; nodes sent over ghosts with soil ",
                           with_soil > 0. ? nodes / with_soil : 0.));
    return lines;
  }
} // namespace talus

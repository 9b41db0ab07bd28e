// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_h
#define talus_checkpoint_checkpoint_h

#include <talus/base/state_list.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/grid/grid.h>
#include <talus/points/points.h>

#include <deal.II/base/parameter_acceptor.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Writes checkpoints, from which a run continues with bit-identical results:
  /// a folder `checkpoints/STEP` in the output folder, with mesh and points in
  /// files of deal.II and p4est, and all other state in `state.h5`. Writing
  /// does not change the run. A checkpoint gets its name only after it is
  /// complete and on disk; the newest two are kept.
  template <int dim>
  class Checkpoint : public dealii::ParameterAcceptor
  {
  public:
    Checkpoint();

    /// Let a new run overwrite the checkpoints of an unfinished run.
    void
    allow_overwriting()
    {
      may_overwrite_ = true;
    }

    /// Throw ExcUser if the folder holds a checkpoint of an unfinished run,
    /// unless allow_overwriting() was called. Collective.
    void
    check_nothing_is_lost(const std::filesystem::path &output_folder,
                          const MPI_Comm               communicator) const
    {
      if (!may_overwrite_)
        check_nothing_unfinished(output_folder, communicator);
    }

    /// Start the clock, and remove checkpoints of an earlier run and incomplete
    /// checkpoints. A run resumed from @p resumed_from keeps the checkpoint,
    /// the previous one, and newer checkpoints, which are damaged.
    void
    begin(const std::filesystem::path &output_folder,
          MPI_Comm                     communicator,
          const std::filesystem::path &resumed_from = {});

    /// Whether a checkpoint is due after step @p step. The wall time counts on
    /// the first rank only, so ranks must agree on the result.
    bool
    is_due(unsigned long step) const;

    /// Whether the wall time limit is reached; always false on all but the
    /// first rank.
    bool
    limit_is_reached() const;

    /// Whether a checkpoint is written at the end of the run.
    bool
    is_wanted_at_the_end() const
    {
      return at_the_end_;
    }

    /// Content of a checkpoint.
    struct Content
    {
      Grid<dim>         &grid;   ///< not changed
      const Points<dim> &points; ///< sorted
      /// Weight of each owned cell at the last repartition.
      const std::vector<double> &cell_weights;
      const StateList           &state;
      const std::string         &parameters; ///< in their final form
      unsigned long              step;
      double                     time;     ///< s
      double                     end_time; ///< s
    };

    /// Write a checkpoint, remove all but this and the previous checkpoint, and
    /// return the path. Throws ExcUser if writing fails; earlier checkpoints
    /// remain. Collective.
    std::filesystem::path
    write(const Content &content);

  private:
    using Clock = std::chrono::steady_clock;

    void
    write_mesh(const std::filesystem::path &folder,
               const Content               &content) const;
    void
    write_state(const std::filesystem::path &folder,
                const Content               &content) const;
    void
    write_file(const std::filesystem::path &path,
               const std::string           &bytes) const;
    /// Throw ExcUser on all ranks if @p error is not empty on any rank.
    void
    check_on_all_ranks(const std::string &error) const;

    // Parameters
    unsigned int step_interval_   = 0;
    double       wall_interval_   = 30.; // min
    double       wall_time_limit_ = 0.;  // min
    bool         at_the_end_      = true;

    bool                  may_overwrite_ = false;
    std::filesystem::path output_folder_;
    MPI_Comm              communicator_ = MPI_COMM_NULL;
    Clock::time_point     start_        = Clock::now();
    Clock::time_point     last_time_    = start_;
    std::filesystem::path last_; // empty if none
  };
} // namespace talus

#endif

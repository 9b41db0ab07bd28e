// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_h
#define talus_checkpoint_checkpoint_h

#include <talus/base/state.h>
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
  /// Writes checkpoints, from which a run can go on as if nothing had happened:
  /// a folder `checkpoints/STEP` in the output folder, with the points and all
  /// other state in `state.h5` and the mesh in files of p4est beside it.
  /// Writing one changes nothing in the run. A checkpoint has its name only
  /// when it is complete and on the disk; the newest two are kept.
  template <int dim>
  class Checkpoint : public dealii::ParameterAcceptor
  {
  public:
    Checkpoint();

    /// Let a run start anew over the checkpoints of an unfinished one.
    void
    allow_overwriting()
    {
      may_overwrite_ = true;
    }

    /// Throw ExcUser if the folder holds the checkpoint of an unfinished run,
    /// unless that may be overwritten. Collective.
    void
    check_nothing_is_lost(const std::filesystem::path &output_folder,
                          MPI_Comm                     communicator) const;

    /// Start the clock. Checkpoints of an earlier run are removed; a run that
    /// resumes from @p resumed_from keeps that one, the one before it and
    /// those, damaged ones, after it. What is half-written goes.
    void
    begin(const std::filesystem::path &output_folder,
          MPI_Comm                     communicator,
          const std::filesystem::path &resumed_from = {});

    /// Whether one is due after step @p step. Only the first rank looks at the
    /// clock, so the ranks must agree on what comes of it.
    bool
    is_due(unsigned long step) const;

    /// Whether the run has taken as long as it may; on the first rank only.
    bool
    limit_is_reached() const;

    /// Whether one is wanted at the end of the run.
    bool
    is_wanted_at_the_end() const
    {
      return at_the_end_;
    }

    /// What is saved besides the mesh.
    struct Content
    {
      const Points<dim> &points; ///< sorted
      /// Of each cell this rank owns, at the last repartition.
      const std::vector<double> &cell_weights;
      const StateList           &state;
      const std::string         &parameters; ///< as understood
      unsigned long              step;
      double                     time;     ///< s
      double                     end_time; ///< s
    };

    /// Write one, remove all but this one and the one before, and return its
    /// path. Throws ExcUser if that fails; then the earlier ones are still
    /// there. Collective.
    std::filesystem::path
    write(const Content &content, const Grid<dim> &grid);

  private:
    using Clock = std::chrono::steady_clock;

    void
    write_state(const std::filesystem::path &folder,
                const Content               &content) const;
    void
    write_mesh(const std::filesystem::path &folder,
               const Grid<dim>             &grid) const;
    /// Throw ExcUser, on all ranks, if there is an error on any.
    void
    check_on_all_ranks(const std::string &error) const;

    // Parameters
    unsigned int step_interval_   = 0;
    double       wall_interval_   = 30.; // min
    double       wall_time_limit_ = 0.;  // min
    bool         at_the_end_      = true;

    bool                  may_overwrite_ = false;
    std::filesystem::path output_folder_;
    MPI_Comm              communicator_ = MPI_COMM_WORLD;
    Clock::time_point     start_        = Clock::now();
    Clock::time_point     last_time_    = start_;
    std::filesystem::path last_; // empty if there is none
  };
} // namespace talus

#endif

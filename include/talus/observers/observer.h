// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_observer_h
#define talus_observers_observer_h

#include <talus/base/state_list.h>
#include <talus/io/files.h>
#include <talus/state/state.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Settings of the user in section Output.
  struct OutputSettings
  {
    std::filesystem::path folder;
    bool                  boxes_as_cells  = false;
    bool                  write_points    = true;
    bool                  write_grid      = true;
    bool                  write_obstacles = true;
    bool                  write_runout    = true;
    double                averaging_time  = 0.1; ///< window for forces, s
    double                plan_interval   = 0;   ///< s; 0: no series
  };



  /// Observes the state of a run after each step, or at times chosen by Output,
  /// without changing the state, and writes files. All members except
  /// list_state() are collective and throw ExcUser if a file cannot be written.
  ///
  /// A new observer is a derived class and a line in Output::list_observers().
  template <int dim>
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /// Return whether the user has requested the observer.
    virtual bool
    is_enabled(const OutputSettings & /*settings*/) const
    {
      return true;
    }

    /// Name of the subfolder of the output folder for the files of the
    /// observer; empty if not needed.
    virtual std::string
    subfolder() const
    {
      return "";
    }

    /// Throw ExcUser if the parameters are invalid. Call when the mesh exists,
    /// before anything is written.
    virtual void
    check(const State<dim> & /*state*/) const
    {}

    /// Start the files; in a resumed run continue the existing files.
    virtual void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) = 0;

    /// Begin the motion: reset quantities counted from here on.
    virtual void
    start(const State<dim> & /*state*/)
    {}

    /// Update quantities that depend on every step. Called after each step.
    virtual void
    follow(const State<dim> & /*state*/)
    {}

    /// Write the output of the current time.
    virtual void
    observe(const State<dim> &state) = 0;

    /// List the amount written so far as state of the run.
    virtual void
    list_state(StateList &list) = 0;

    /// Return an error sentence, on the first rank, if a resumed run cannot
    /// continue with the files in the folder; else an empty string. Call after
    /// the state has been loaded.
    virtual std::string
    cannot_resume(const OutputSettings & /*settings*/,
                  const State<dim> & /*state*/) const
    {
      return "";
    }

    /// Names, on the first rank, of files written so far, by the current run or
    /// the run it continues, but deleted since. Can be called before begin().
    virtual std::vector<std::string>
    missing_files(const OutputSettings & /*settings*/) const
    {
      return {};
    }

    /// Force all output written so far to disk.
    virtual void
    sync() = 0;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_observer_h
#define talus_observers_observer_h

#include <talus/base/state.h>
#include <talus/io/files.h>
#include <talus/state/state.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// What the user wants of the output, section Output.
  struct OutputSettings
  {
    std::filesystem::path folder;
    std::string           format          = "vtu"; ///< see make_field_writer()
    bool                  boxes_as_cells  = false;
    bool                  write_points    = true;
    bool                  write_grid      = true;
    bool                  write_obstacles = true;
    bool                  write_runout    = true;
    double                averaging_time  = 0.1; ///< of forces, s
  };



  /// Looks at the state of a run at times that Output chooses, or after each
  /// step, changes nothing and writes files of its own. All members but
  /// list_state() are collective; they throw ExcUser if a file cannot be
  /// written.
  ///
  /// A new observer is a class of this kind and a line in
  /// Output::list_observers().
  template <int dim>
  class Observer
  {
  public:
    virtual ~Observer() = default;

    /// Whether the user wants it.
    virtual bool
    is_enabled(const OutputSettings & /*settings*/) const
    {
      return true;
    }

    /// Name of the folder in the output folder that it makes for its files;
    /// empty if it makes none.
    virtual std::string
    subfolder() const
    {
      return "";
    }

    /// Throw ExcUser if its parameters cannot be followed; nothing is written
    /// yet. To be called when the mesh is there.
    virtual void
    check(const State<dim> & /*state*/) const
    {}

    /// Start the files, or go on with them in a resumed run.
    virtual void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) = 0;

    /// The motion begins: what counts from there starts from zero.
    virtual void
    start(const State<dim> & /*state*/)
    {}

    /// A step is done: take what must be seen in every step.
    virtual void
    follow(const State<dim> & /*state*/)
    {}

    /// Write what there is to see now.
    virtual void
    observe(const State<dim> &state) = 0;

    /// Add what was written so far to the state of the run.
    virtual void
    list_state(StateList &list) = 0;

    /// Why a resumed run cannot go on with the files in the folder, a sentence
    /// on the first rank; empty if it can. To be called when the state was
    /// loaded.
    virtual std::string
    cannot_resume(const OutputSettings & /*settings*/,
                  const State<dim> & /*state*/) const
    {
      return "";
    }

    /// Names of the files written so far, by this run or the one that it goes
    /// on with, that somebody has removed, on the first rank. Also before begin().
    virtual std::vector<std::string>
    missing_files(const OutputSettings & /*settings*/) const
    {
      return {};
    }

    /// Bring all that was written to the disk.
    virtual void
    sync() = 0;
  };
} // namespace talus

#endif

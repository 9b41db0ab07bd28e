// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_python_led_run_h
#define talus_python_led_run_h

#include <pybind11/pybind11.h>

#include <talus/application/run.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace talus::python
{
  /// A run led by Python.
  ///
  /// Python's lock (GIL) is released while the run computes, and held while it
  /// calls a function of Python. Another thread of Python may then call another
  /// run, which waits for its turn: MPI and deal.II serve one thread at a time.
  class LedRun
  {
  public:
    /// Make a run from a parameter file, or from the text of one if @p is_text.
    /// @p communicator: see communicator_of().
    LedRun(const std::string              &file_or_text,
           bool                            is_text,
           const std::vector<std::string> &overrides,
           const RunOptions               &options,
           const pybind11::object         &communicator);

    ~LedRun();

    /// Destroy the run, after the calls of other threads; files and memory are
    /// released. A closed run is left unchanged.
    void
    close();

    /// Run::advance_to(), with @p callback, a function without arguments or
    /// None, after each step. Ctrl-C raises KeyboardInterrupt between two
    /// steps.
    bool
    advance_to(double time, const pybind11::object &callback);

    std::string
    write_checkpoint();

    Quantities
    statistics();

    Quantities
    accounts();

    /// Return the result of @p action, a function of a Run, for the run. Waits
    /// for the calls of other threads. Throws ExcUser if the run is closed, or
    /// advances in another thread.
    template <typename Action>
    auto
    use(const Action &action) const
    {
      const std::unique_lock<std::recursive_mutex> turn = wait_for_turn();
      return std::invoke(action, run());
    }

  private:
    std::unique_lock<std::recursive_mutex>
    wait_for_turn() const;

    /// Call use() without Python's lock, when no other run computes.
    template <typename Action>
    auto
    compute(const Action &action) const;

    /// The run, which must be open.
    Run &
    run() const;

    void
    after_step(const pybind11::object &callback) const;

    std::unique_ptr<Run> run_;
    std::atomic<bool>    is_advancing_ = false;

    /// Held by the thread that uses the run. Recursive, because a function of
    /// Python that the run calls may use the run. A thread with Python's lock
    /// never waits for the turn: the owner may need Python's lock.
    mutable std::recursive_mutex turn_;
  };



  /// Let a function of Python give the velocity of an obstacle, components in
  /// m/s, from the time, s.
  void
  prescribe_velocity(RunOptions               &options,
                     const std::string        &obstacle,
                     const pybind11::function &velocity);

  /// Close all open runs.
  void
  close_all_runs();
} // namespace talus::python

#endif

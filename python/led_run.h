// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_python_led_run_h
#define talus_python_led_run_h

#include <pybind11/pybind11.h>

#include <talus/application/run.h>

#include <memory>
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

    /// Destroy the run; files and memory are released. A closed run is left
    /// unchanged.
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

    unsigned int
    rank() const;

    unsigned int
    n_ranks() const;

    /// The run, which must be open and must not compute in another thread.
    Run &
    run() const;

  private:
    void
    after_step(const pybind11::object &callback) const;

    std::unique_ptr<Run> run_;
    bool                 is_advancing_ = false;
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

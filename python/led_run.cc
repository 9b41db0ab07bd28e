// SPDX-License-Identifier: LGPL-2.1-or-later
#include "led_run.h"

#include <pybind11/stl.h>

#include <talus/application/parameter_file.h>
#include <talus/base/errors.h>

#include <deal.II/base/mpi.h>

#include <mutex>
#include <set>

#include "mpi_of_module.h"

namespace talus::python
{
  namespace py = pybind11;

  namespace
  {
    /// Held by the thread whose run computes. Recursive, because a function of
    /// Python that a run calls may use another run. Taken before the turn of a
    /// run.
    std::recursive_mutex computing;

    /// All open runs. Used with Python's lock.
    std::set<LedRun *> open_runs;



    /// Lock @p mutex. Waiting with Python's lock would stop the functions of
    /// Python that the owner of the mutex calls.
    std::unique_lock<std::recursive_mutex>
    lock(std::recursive_mutex &mutex)
    {
      const py::gil_scoped_release release;
      return std::unique_lock<std::recursive_mutex>(mutex);
    }
  } // namespace



  std::unique_lock<std::recursive_mutex>
  LedRun::wait_for_turn() const
  {
    std::unique_lock<std::recursive_mutex> turn(turn_, std::try_to_lock);
    if (turn.owns_lock())
      return turn;
    AssertThrow(!is_advancing_,
                ExcUser("The run advances in another thread. Wait for the end "
                        "of advance_to(), or read the state in its "
                        "callback."));
    return lock(turn_);
  }



  template <typename Action>
  auto
  LedRun::compute(const Action &action) const
  {
    wait_for_turn(); // throws if the run advances in another thread
    const auto library = lock(computing);
    return use([&action](Run &run) {
      const py::gil_scoped_release release;
      return action(run);
    });
  }



  LedRun::LedRun(const std::string              &file_or_text,
                 const bool                      is_text,
                 const std::vector<std::string> &overrides,
                 const RunOptions               &options,
                 const py::object               &communicator)
  {
    const MPI_Comm ranks   = communicator_of(communicator);
    const auto     library = lock(computing);
    {
      const py::gil_scoped_release release;
      const ParameterFile          file =
        is_text ? ParameterFile::from_text(file_or_text, overrides)
                         : ParameterFile(file_or_text, overrides, ranks);
      run_ = std::make_unique<Run>(file, options, ranks);
    }
    open_runs.insert(this);
  }



  LedRun::~LedRun()
  {
    open_runs.erase(this);
  }



  void
  LedRun::close()
  {
    wait_for_turn(); // throws if the run advances in another thread
    const auto library = lock(computing);
    const auto turn    = wait_for_turn();
    AssertThrow(!is_advancing_,
                ExcUser("A function that is called by a run closes the run. "
                        "Call stop() there, and close() after advance_to()."));
    open_runs.erase(this);
    run_.reset();
  }



  Run &
  LedRun::run() const
  {
    AssertThrow(run_ != nullptr,
                ExcUser("The run has been closed. Make a new one."));
    return *run_;
  }



  void
  LedRun::after_step(const py::object &callback) const
  {
    const py::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    if (!callback.is_none())
      callback();
  }



  bool
  LedRun::advance_to(const double time, const py::object &callback)
  {
    struct Advancing
    {
      std::atomic<bool> &flag;
      explicit Advancing(std::atomic<bool> &f)
        : flag(f)
      {
        flag = true;
      }
      ~Advancing()
      {
        flag = false;
      }
    };
    return compute([&](Run &run) {
      AssertThrow(!is_advancing_,
                  ExcUser("A function that is called by a run advances the "
                          "run. Return from the function first."));
      const Advancing scope(is_advancing_);
      run.set_observer([this, &callback]() { after_step(callback); });
      return run.advance_to(time);
    });
  }



  std::string
  LedRun::write_checkpoint()
  {
    return compute([](Run &run) { return run.write_checkpoint(); });
  }



  Quantities
  LedRun::statistics()
  {
    return compute([](Run &run) { return run.statistics(); });
  }



  Quantities
  LedRun::accounts()
  {
    return compute([](Run &run) { return run.accounts(); });
  }



  // The function of Python is destroyed with the run, with Python's lock, as
  // close() holds it.
  void
  prescribe_velocity(RunOptions         &options,
                     const std::string  &obstacle,
                     const py::function &velocity)
  {
    const auto shared = std::make_shared<py::function>(velocity);
    options.obstacle_velocities[obstacle] = [obstacle,
                                             shared](const double time) {
      const py::gil_scoped_acquire lock;
      const py::object             value = (*shared)(time);
      try
        {
          return value.cast<std::vector<double>>();
        }
      catch (const py::cast_error &)
        {
          throw ExcUser(text("The velocity of the obstacle '",
                             obstacle,
                             "', prescribed by the program that leads the "
                             "run, is ",
                             py::repr(value).cast<std::string>(),
                             " at t = ",
                             time,
                             " s, where a list of numbers in m/s was expected. "
                             "Correct the function."));
        }
    };
  }



  void
  close_all_runs()
  {
    while (!open_runs.empty())
      (*open_runs.begin())->close();
  }
} // namespace talus::python

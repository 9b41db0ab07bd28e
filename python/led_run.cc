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
    /// Python that a run calls may use this or another run.
    std::recursive_mutex computing;

    /// Whether a thread computes without Python's lock. Read and written with
    /// the lock.
    bool is_computing = false;

    /// All open runs. Used with Python's lock.
    std::set<LedRun *> open_runs;



    /// Python's lock, held in a function of Python that a run calls.
    class InPython
    {
    public:
      InPython()
      {
        is_computing = false;
      }

      ~InPython()
      {
        is_computing = true;
      }

    private:
      py::gil_scoped_acquire lock_;
    };



    /// Call @p action without Python's lock, when no other thread computes.
    /// Waiting for the other thread with Python's lock would stop the functions
    /// of Python that the other thread calls.
    template <typename Action>
    auto
    compute(const Action &action)
    {
      struct Flag
      {
        Flag()
        {
          is_computing = true;
        }

        ~Flag()
        {
          is_computing = before;
        }

        bool before = is_computing;
      };
      std::unique_lock<std::recursive_mutex> turn(computing, std::defer_lock);
      {
        const py::gil_scoped_release release;
        turn.lock();
      }
      const Flag                   flag;
      const py::gil_scoped_release release;
      return action();
    }
  } // namespace



  LedRun::LedRun(const std::string              &file_or_text,
                 const bool                      is_text,
                 const std::vector<std::string> &overrides,
                 const RunOptions               &options,
                 const py::object               &communicator)
  {
    const MPI_Comm ranks = communicator_of(communicator);
    compute([&]() {
      const ParameterFile file =
        is_text ? ParameterFile::from_text(file_or_text, overrides)
                : ParameterFile(file_or_text, overrides, ranks);
      run_ = std::make_unique<Run>(file, options, ranks);
    });
    open_runs.insert(this);
  }



  LedRun::~LedRun()
  {
    open_runs.erase(this);
  }



  void
  LedRun::close()
  {
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
    AssertThrow(!is_advancing_ || !is_computing,
                ExcUser("The run advances in another thread. Wait for the end "
                        "of advance_to(), or read the state in its "
                        "callback."));
    return *run_;
  }



  void
  LedRun::after_step(const py::object &callback) const
  {
    const InPython scope;
    if (PyErr_CheckSignals() != 0)
      throw py::error_already_set();
    if (!callback.is_none())
      callback();
  }



  bool
  LedRun::advance_to(const double time, const py::object &callback)
  {
    Run &run = this->run();
    AssertThrow(!is_advancing_,
                ExcUser("A function that is called by a run advances the run. "
                        "Return from the function first."));
    struct Advancing
    {
      bool &flag;
      explicit Advancing(bool &f)
        : flag(f)
      {
        flag = true;
      }
      ~Advancing()
      {
        flag = false;
      }
    };
    const Advancing scope(is_advancing_);
    run.set_observer([this, &callback]() { after_step(callback); });
    return compute([&]() { return run.advance_to(time); });
  }



  std::string
  LedRun::write_checkpoint()
  {
    Run &run = this->run();
    return compute([&]() { return run.write_checkpoint(); });
  }



  Quantities
  LedRun::statistics()
  {
    Run &run = this->run();
    return compute([&]() { return run.statistics(); });
  }



  Quantities
  LedRun::accounts()
  {
    Run &run = this->run();
    return compute([&]() { return run.accounts(); });
  }



  unsigned int
  LedRun::rank() const
  {
    return dealii::Utilities::MPI::this_mpi_process(run().communicator());
  }



  unsigned int
  LedRun::n_ranks() const
  {
    return dealii::Utilities::MPI::n_mpi_processes(run().communicator());
  }



  // The function of Python is destroyed with the run, with Python's lock, as
  // close() holds it.
  void
  prescribe_velocity(RunOptions         &options,
                     const std::string  &obstacle,
                     const py::function &velocity)
  {
    const auto shared = std::make_shared<py::function>(velocity);
    options.obstacle_velocities[obstacle] = [shared](const double time) {
      const InPython scope;
      return (*shared)(time).cast<std::vector<double>>();
    };
  }



  void
  close_all_runs()
  {
    while (!open_runs.empty())
      (*open_runs.begin())->close();
  }
} // namespace talus::python

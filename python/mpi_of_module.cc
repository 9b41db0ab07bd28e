// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mpi_of_module.h"

#include <talus/base/errors.h>
#include <talus/base/mpi_setup.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/multithread_info.h>

#include <p4est.h>
#include <sc.h>

#include <cstdint>
#include <memory>

#include "led_run.h"

namespace talus::python
{
  namespace py = pybind11;

  namespace
  {
    /// MPI of this process, if the module has initialized it.
    std::unique_ptr<dealii::Utilities::MPI::MPI_InitFinalize> own_mpi;
  } // namespace



  /// deal.II's class refuses to start if MPI has been initialized. What else
  /// the class does, and talus needs, is then done here: one thread, and no
  /// output of p4est.
  void
  begin_mpi()
  {
    int is_initialized = 0;
    MPI_Initialized(&is_initialized);
    prepare_mpi();
    if (is_initialized)
      {
        dealii::MultithreadInfo::set_thread_limit(1);
        sc_init(MPI_COMM_NULL, 0, 0, nullptr, SC_LP_SILENT);
        p4est_init(nullptr, SC_LP_SILENT);
        return;
      }
    // As by the program, the libraries get no options.
    static char  name[]    = "talus";
    static char *words[]   = {name, nullptr};
    int          n_words   = 1;
    char       **arguments = words;
    own_mpi =
      std::make_unique<dealii::Utilities::MPI::MPI_InitFinalize>(n_words,
                                                                 arguments,
                                                                 1);
  }



  void
  end_mpi()
  {
    const bool has_failed =
      py::hasattr(py::module_::import("sys"), "last_type");
    int is_finalized = 0;
    MPI_Finalized(&is_finalized);
    if (has_failed && !is_finalized &&
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      MPI_Abort(MPI_COMM_WORLD, 1);
    close_all_runs();
    own_mpi.reset();
  }



  MPI_Comm
  communicator_of(const py::object &communicator)
  {
    if (communicator.is_none())
      return MPI_COMM_WORLD;
    if (py::isinstance<py::str>(communicator))
      {
        const auto name = communicator.cast<std::string>();
        AssertThrow(name == "self",
                    ExcUser("The communicator '" + name +
                            "' was given, where 'self', None or a "
                            "communicator of mpi4py was expected."));
        return MPI_COMM_SELF;
      }
    const auto address = py::module_::import("mpi4py.MPI")
                           .attr("_addressof")(communicator)
                           .cast<std::uintptr_t>();
    return *reinterpret_cast<const MPI_Comm *>(address);
  }
} // namespace talus::python

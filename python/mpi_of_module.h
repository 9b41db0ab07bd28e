// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_python_mpi_of_module_h
#define talus_python_mpi_of_module_h

#include <pybind11/pybind11.h>

#include <mpi.h>

namespace talus::python
{
  /// Initialize MPI, unless somebody has done so, and the libraries that need
  /// to be initialized.
  void
  begin_mpi();

  /// Close all runs, and finalize MPI if begin_mpi() has initialized it. If the
  /// program of the user ends with an exception, other ranks may wait for this
  /// rank for ever: they are aborted.
  void
  end_mpi();

  /// Return the communicator of an object of mpi4py, MPI_COMM_SELF for "self",
  /// or MPI_COMM_WORLD for None. Throws ExcUser at another text.
  MPI_Comm
  communicator_of(const pybind11::object &communicator);
} // namespace talus::python

#endif

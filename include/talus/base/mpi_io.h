// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_mpi_io_h
#define talus_base_mpi_io_h

#include <cstdlib>

namespace talus
{
  /// Ask Open MPI for ROMIO, unless the user has a say; to be called before
  /// MPI_Init. Open MPI's own MPI-IO guards a file that it opens by a semaphore
  /// which is named after the file without its folder and outlives a program
  /// that is killed: one killed there, and all checkpoints on this machine would
  /// wait for ever. Other MPIs do not read this.
  inline void
  choose_mpi_io()
  {
    setenv("OMPI_MCA_io", "^ompio", /*overwrite=*/0);
  }
} // namespace talus

#endif

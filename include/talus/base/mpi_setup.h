// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_mpi_setup_h
#define talus_base_mpi_setup_h

#include <cstdlib>

namespace talus
{
  /// Tell Open MPI what suits talus, unless the user has a say; to be called
  /// before MPI_Init. Other MPIs do not read this.
  ///
  /// Files are written by ROMIO: Open MPI's own MPI-IO guards a file that it
  /// opens by a semaphore which is named after the file without its folder and
  /// outlives a program that is killed: one killed there, and all checkpoints on
  /// this machine would wait for ever.
  ///
  /// A program that no launcher has started is alone and need not look at all
  /// kinds of networks, which takes 0.2 s. (It could do without the daemon that
  /// Open MPI starts for it, too, but then several programs at a time would have
  /// the same names of folders and of shared memory.)
  inline void
  prepare_mpi()
  {
    constexpr int keep = 0;
    setenv("OMPI_MCA_io", "^ompio", keep);
    for (const char *launched :
         {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
      if (std::getenv(launched) != nullptr)
        return;
    setenv("OMPI_MCA_pml", "ob1", keep);
  }
} // namespace talus

#endif

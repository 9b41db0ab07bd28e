// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_rows_h
#define talus_io_hdf5_rows_h

#include <talus/io/hdf5_handle.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  /// Write or read (@p transfer is H5Dwrite or H5Dread) the rows [first, first
  /// + n_rows) of an array. Returns whether the transfer succeeded.
  template <typename Transfer, typename Values>
  bool
  transfer_rows(const Transfer transfer,
                const hid_t    array,
                const hid_t    type,
                const hsize_t  first,
                const hsize_t  n_rows,
                const hsize_t  n_columns,
                Values        *values)
  {
    const hsize_t    start[2] = {first, 0}, count[2] = {n_rows, n_columns};
    const int        rank = (n_columns == 1 ? 1 : 2);
    const Hdf5Handle file_space(H5Dget_space(array), H5Sclose);
    if (H5Sget_simple_extent_npoints(file_space) == 0)
      return true;
    const Hdf5Handle memory_space(H5Screate_simple(rank, count, nullptr),
                                  H5Sclose);
    const Hdf5Handle together(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
    H5Pset_dxpl_mpio(together, H5FD_MPIO_COLLECTIVE);
    // A rank without rows takes part with an empty selection: the call is
    // collective.
    const herr_t selected =
      (n_rows == 0
         ? H5Sselect_none(memory_space) + H5Sselect_none(file_space)
         : H5Sselect_hyperslab(
             file_space, H5S_SELECT_SET, start, nullptr, count, nullptr));
    // Also after a failed selection, because all ranks take part in the call.
    const herr_t status =
      transfer(array, type, memory_space, file_space, together, values);
    return selected >= 0 && status >= 0;
  }
} // namespace talus

#endif

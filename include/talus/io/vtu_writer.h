// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_vtu_writer_h
#define talus_io_vtu_writer_h

#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <ostream>

namespace talus
{
  /// Write the cells of this rank as a complete VTU file: single precision,
  /// compressed, without date. The fields become cell or point data according
  /// to OutputCells::items_at. (deal.II's writer has point data only, and each
  /// box would hold the values at every corner.)
  void
  write_vtu(std::ostream &out, const OutputCells &cells);



  /// Write the cells of all ranks into the VTU file @p path, a piece for each
  /// rank with cells. The first rank writes the file, completely or, with
  /// ExcUser, not at all. Collective.
  void
  write_vtu(const std::filesystem::path &path,
            MPI_Comm                     communicator,
            const OutputCells           &cells);



  /// Return whether a VTU file exists and is complete up to the end.
  bool
  is_complete_vtu(const std::filesystem::path &path);
} // namespace talus

#endif

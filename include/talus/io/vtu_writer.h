// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_vtu_writer_h
#define talus_io_vtu_writer_h

#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <vector>

namespace talus
{
  /// Write @p n bytes as base64 (RFC 4648), padded with '='.
  void
  write_base64(std::ostream &out, const unsigned char *bytes, std::size_t n);



  /// Write the content of a DataArray of VTK's XML files with format="binary"
  /// and compressor="vtkZLibDataCompressor": base64 of the four numbers 1,
  /// size, size and compressed size [bytes], followed by base64 of the
  /// compressed values.
  template <typename Number>
  void
  write_vtu_array(std::ostream &out, const std::vector<Number> &values);



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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_hdf5_writer_h
#define talus_io_hdf5_writer_h

#include <talus/io/field_writer.h>

namespace talus
{
  /// Format with a single HDF5 file base.h5 per output time for any number of
  /// ranks. The index is NAME.xdmf.
  ///
  /// Group "mesh" has the datasets "vertices" (x, y, z [m]) and "cells" (rows
  /// of "vertices" that make up each cell, in VTK's order; attribute "type" is
  /// the type of XDMF). Group "fields" has a dataset per field, named after the
  /// field without unit; attributes are "name" (with unit), "unit" and "at"
  /// (whether a row is a vertex or a cell).
  class Hdf5Writer : public FieldWriter
  {
  public:
    static constexpr const char *documentation =
      "one file per output time whatever the number of ranks, to be opened by "
      "points.xdmf and grid.xdmf";

    IndexEntry
    write(const std::filesystem::path        &folder,
          const std::string                  &base,
          MPI_Comm                            communicator,
          const OutputCells                  &cells,
          std::vector<std::filesystem::path> &unsynced) const override;

    bool
    is_complete(const std::filesystem::path &path) const override;

    std::string
    index_name(const std::string &name) const override
    {
      return name + ".xdmf";
    }

    /// Write the index. Files that no longer exist are left out.
    std::filesystem::path
    write_index(const std::filesystem::path   &folder,
                const std::string             &name,
                const std::vector<IndexEntry> &entries) const override;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_vtu_writer_h
#define talus_io_vtu_writer_h

#include <talus/io/field_writer.h>

#include <ostream>

namespace talus
{
  /// Format of VTK: with one rank a file base.vtu; with several ranks
  /// base.R.vtu for each rank R with cells, and base.pvtu. The index is
  /// NAME.pvd.
  class VtuWriter : public FieldWriter
  {
  public:
    static constexpr const char *documentation =
      "one file per rank and output time, to be opened by points.pvd and "
      "grid.pvd";

    IndexEntry
    write(const std::filesystem::path        &folder,
          const std::string                  &base,
          MPI_Comm                            communicator,
          const OutputCells                  &cells,
          std::vector<std::filesystem::path> &unsynced) const override;

    std::vector<std::string>
    files_of(const std::filesystem::path &folder,
             const IndexEntry            &entry) const override;

    bool
    is_complete(const std::filesystem::path &path) const override;

    std::string
    index_name(const std::string &name) const override
    {
      return name + ".pvd";
    }

    std::filesystem::path
    write_index(const std::filesystem::path   &folder,
                const std::string             &name,
                const std::vector<IndexEntry> &entries) const override;
  };



  /// Write the cells of this rank as a complete VTU file: single precision,
  /// compressed, without date. The fields become cell or point data according
  /// to OutputCells::items_at. (deal.II's writer has point data only, and each
  /// box would hold the values at every corner.)
  void
  write_vtu(std::ostream &out, const OutputCells &cells);
} // namespace talus

#endif

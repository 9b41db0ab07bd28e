// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_field_writer_h
#define talus_io_field_writer_h

#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Entry of the index of a series, for one output time.
  struct IndexEntry
  {
    double      time; ///< s
    std::string file; ///< file for ParaView to open
    /// Further lines of the index, each beginning with a blank.
    std::string description;
  };



  /// Base class of the formats of output files.
  class FieldWriter
  {
  public:
    virtual ~FieldWriter() = default;

    /// Write the cells of all ranks into @p folder. Collective. Throws ExcUser
    /// on failure.
    /// @param base first part of the names of the files
    /// @param unsynced files written by this rank and not yet synced to the
    ///   disk are appended
    virtual IndexEntry
    write(const std::filesystem::path        &folder,
          const std::string                  &base,
          MPI_Comm                            communicator,
          const OutputCells                  &cells,
          std::vector<std::filesystem::path> &unsynced) const = 0;

    /// Return the names of all files in @p folder for an output. Names that
    /// only a lost file contains are missing.
    virtual std::vector<std::string>
    files_of(const std::filesystem::path & /*folder*/,
             const IndexEntry &entry) const
    {
      return {entry.file};
    }

    /// Return whether a file of files_of() is complete up to the end.
    virtual bool
    is_complete(const std::filesystem::path &path) const = 0;

    /// Return the name of the file that write_index() writes for a series.
    virtual std::string
    index_name(const std::string &name) const = 0;

    /// Write the file NAME.* that gives ParaView the times of the outputs, all
    /// in @p folder, and return the path. For the first rank only. Throws
    /// ExcUser on failure.
    virtual std::filesystem::path
    write_index(const std::filesystem::path   &folder,
                const std::string             &name,
                const std::vector<IndexEntry> &entries) const = 0;
  };



  /// Return the names of all formats, separated as in deal.II's
  /// Patterns::Selection.
  std::string
  field_format_names();

  /// Return the description of the formats for the documentation of a
  /// parameter.
  std::string
  field_format_documentation();

  /// Make the writer of the named format. Throws ExcUser if the name is
  /// unknown.
  std::unique_ptr<FieldWriter>
  make_field_writer(const std::string &format);
} // namespace talus

#endif

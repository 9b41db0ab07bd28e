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
  /// What the index of a series is to say of one output time.
  struct IndexEntry
  {
    double      time; ///< s
    std::string file; ///< the one that ParaView is to open
    /// What the format needs besides; whole lines, each beginning with a blank.
    std::string description;
  };



  /// A format of output files.
  class FieldWriter
  {
  public:
    virtual ~FieldWriter() = default;

    /// Write the cells of all ranks into the folder, to one or several files
    /// whose names begin with @p base. Appends to @p unsynced what this rank
    /// wrote and did not bring to the disk. Collective. Throws ExcUser if it
    /// fails.
    virtual IndexEntry
    write(const std::filesystem::path        &folder,
          const std::string                  &base,
          MPI_Comm                            communicator,
          const OutputCells                  &cells,
          std::vector<std::filesystem::path> &unsynced) const = 0;

    /// The names of all files in @p folder that an output consists of, as far
    /// as those that are there tell.
    virtual std::vector<std::string>
    files_of(const std::filesystem::path & /*folder*/,
             const IndexEntry &entry) const
    {
      return {entry.file};
    }

    /// Whether a file of files_of() has its end, as it was written.
    virtual bool
    is_complete(const std::filesystem::path &path) const = 0;

    /// The name of the file that write_index() writes for this series.
    virtual std::string
    index_name(const std::string &name) const = 0;

    /// Write the file NAME.* that gives ParaView the times of these outputs,
    /// all in @p folder, and return its path; for one rank. Throws ExcUser if
    /// that fails.
    virtual std::filesystem::path
    write_index(const std::filesystem::path   &folder,
                const std::string             &name,
                const std::vector<IndexEntry> &entries) const = 0;
  };



  /// The names of all formats, as deal.II's Patterns::Selection wants them.
  std::string
  field_format_names();

  /// What there is to say of the formats, for the user.
  std::string
  field_format_documentation();

  /// The writer of the format with this name. Throws ExcUser if there is none.
  std::unique_ptr<FieldWriter>
  make_field_writer(const std::string &format);
} // namespace talus

#endif

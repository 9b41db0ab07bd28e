// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_series_h
#define talus_io_series_h

#include <talus/io/field_writer.h>
#include <talus/io/files.h>

namespace talus
{
  /// Sequence of outputs over time, name-0000.*, name-0001.*, ..., with an
  /// index that gives ParaView the times.
  class FieldSeries
  {
  public:
    /// Start a new series, or continue after the files present at the
    /// checkpoint.
    void
    begin(const std::filesystem::path &folder,
          const std::string           &name,
          MPI_Comm                     communicator,
          const std::string           &format,
          Beginning                    beginning = Beginning::fresh);

    /// Add the entries of the index to the state of the run, as the text
    /// @p name: per output a line with the time [s], a blank and the name of
    /// the file, followed by the lines of the description.
    void
    list_state(const std::string &name, StateList &list);

    /// Return whether there are no files, including files before a resumed run.
    bool
    is_empty() const
    {
      return entries_.empty();
    }

    /// Write the files of the next output time. Collective. Throws ExcUser on
    /// failure.
    void
    write(const OutputCells &cells);

    /// Return the names of files that were removed from the folder or cut
    /// short: the index and all files of the index. Also before begin(). For
    /// the first rank.
    std::vector<std::string>
    missing_files(const std::filesystem::path &folder,
                  const std::string           &name,
                  const std::string           &format) const;

    /// Sync all files that this rank wrote to the disk. Throws ExcUser on
    /// failure.
    void
    sync();

  private:
    std::filesystem::path              folder_;
    std::string                        name_;
    MPI_Comm                           communicator_ = MPI_COMM_NULL;
    std::unique_ptr<FieldWriter>       writer_;
    std::vector<IndexEntry>            entries_;
    std::vector<std::filesystem::path> unsynced_;
  };
} // namespace talus

#endif

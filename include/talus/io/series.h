// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_series_h
#define talus_io_series_h

#include <talus/io/field_writer.h>
#include <talus/io/files.h>

namespace talus
{
  /// A sequence of outputs over time, name-0000.*, name-0001.*, ..., and an
  /// index that gives ParaView their times.
  class FieldSeries
  {
  public:
    /// Start anew, or go on after the files that were there at the checkpoint.
    void
    begin(const std::filesystem::path &folder,
          const std::string           &name,
          MPI_Comm                     communicator,
          const std::string           &format,
          Beginning                    beginning = Beginning::fresh);

    /// Add what the index says to the state of the run, as the text @p name:
    /// per output a line with the time [s], a space and the name of the file,
    /// then the lines that describe it.
    void
    list_state(const std::string &name, StateList &list);

    /// Whether there are no files so far, nor at the checkpoint.
    bool
    is_empty() const
    {
      return entries_.empty();
    }

    /// Write the files of the next output time; collective. Throws ExcUser if
    /// that fails.
    void
    write(const OutputCells &cells);

    /// Names of the files in the index, and of the index, that somebody has
    /// removed from the folder, and of files that were cut short; also before begin(). To be asked on the first
    /// rank.
    std::vector<std::string>
    missing_files(const std::filesystem::path &folder,
                  const std::string           &name,
                  const std::string           &format) const;

    /// Bring all files that this rank wrote to the disk. Throws ExcUser if that
    /// fails.
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

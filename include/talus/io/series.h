// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_series_h
#define talus_io_series_h

#include <talus/io/files.h>
#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  /// Sequence of outputs over time, name-0000.vtu, name-0001.vtu, ..., with an
  /// index name.pvd that gives ParaView the times.
  class FieldSeries
  {
  public:
    /// Start a new series, or continue after the files present at the
    /// checkpoint.
    void
    begin(const std::filesystem::path &folder,
          const std::string           &name,
          MPI_Comm                     communicator,
          Beginning                    beginning = Beginning::fresh);

    /// Add the entries of the index to the state of the run, as the text
    /// @p name: per output a line with the time [s], a blank and the name of
    /// the file.
    void
    list_state(const std::string &name, StateList &list);

    /// Return whether there are no files, including files before a resumed run.
    bool
    is_empty() const
    {
      return entries_.empty();
    }

    /// Write the file of the next output time. Collective. Throws ExcUser on
    /// failure.
    void
    write(const OutputCells &cells);

    /// Return the names of files that were removed from the folder or cut
    /// short: the index and all files of the index. Also before begin(). For
    /// the first rank.
    std::vector<std::string>
    missing_files(const std::filesystem::path &folder,
                  const std::string           &name) const;

    /// Sync all files that this rank wrote to the disk. Throws ExcUser on
    /// failure.
    void
    sync();

  private:
    /// Entry of the index.
    struct Entry
    {
      double      time; ///< s
      std::string file;
    };

    void
    write_index() const;

    std::filesystem::path folder_;
    std::string           name_;
    MPI_Comm              communicator_ = MPI_COMM_NULL;
    std::vector<Entry>    entries_;
    std::size_t n_synced_ = 0; ///< entries whose files are on the disk
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_files_h
#define talus_io_files_h

#include <talus/base/state_list.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Whether a run begins at its start or goes on from a checkpoint.
  enum class Beginning
  {
    fresh,
    resumed
  };



  /// Make the folder (and those above it) unless it is there. Throws ExcUser
  /// if that fails.
  void
  make_folder(const std::filesystem::path &folder);



  /// Remember a file that the run reads, such as its parameters: no output is
  /// written over it.
  void
  protect_input(const std::filesystem::path &path);



  /// Why @p path cannot be written, a sentence, if it is such a file, under
  /// whatever name; else empty.
  std::string
  clash_with_input(const std::filesystem::path &path);



  /// Throw ExcUser if @p path is such a file.
  void
  check_not_input(const std::filesystem::path &path);



  /// Make the file @p path from what @p write puts into the stream: all of it
  /// or, with ExcUser, nothing; an older file of that name survives a failure.
  /// If the machine dies, not only the program, the new file may be found
  /// empty, unless it was brought to the disk by sync_to_disk(). That waits for
  /// the disk, often longer than a file takes to write.
  void
  write_file(const std::filesystem::path               &path,
             const std::function<void(std::ostream &)> &write);



  /// Bring the content of a file, or the names in a folder, to the disk.
  /// Returns why that failed, empty if it did not.
  std::string
  sync_to_disk(const std::filesystem::path &path);



  /// The sentence that says that the file @p path could not be written.
  std::string
  failed_write(const std::filesystem::path &path, const std::string &reason);



  /// A text that grows line by line.
  class LogFile
  {
  public:
    /// Start a new file, or append to it in a resumed run. Throws ExcUser if
    /// that fails.
    void
    open(const std::filesystem::path &path,
         Beginning                    beginning = Beginning::fresh);

    /// Append a line, at once. Throws ExcUser if that fails.
    void
    add_line(const std::string &line);

  private:
    std::filesystem::path path_;
    std::ofstream         file_;
  };



  /// Return a field of a CSV table: 16 significant digits, so that two runs can
  /// be compared to round-off; empty if @p value is NaN, for a quantity that has
  /// no value.
  std::string
  csv_field(double value);



  /// A table that grows row by row, comma separated; see csv_field().
  class CsvFile
  {
  public:
    /// Start a new file with one header line; in a resumed run go on behind
    /// what the file held at the checkpoint. Throws ExcUser if that fails.
    void
    open(const std::filesystem::path    &path,
         const std::vector<std::string> &names,
         Beginning                       beginning = Beginning::fresh);

    /// Why the run cannot go on with the file @p path, which should have these
    /// columns, from the checkpoint that was loaded; empty if it can.
    std::string
    cannot_resume(const std::filesystem::path    &path,
                  const std::vector<std::string> &names) const;

    /// Add the length of the file to the state of the run.
    void
    list_state(const std::string &name, StateList &list);

    /// Append a row; it is in the file only after flush().
    void
    add_row(const std::vector<double> &values);

    /// Hand all rows to the operating system, so that a reader sees them while
    /// the simulation runs. Throws ExcUser if that fails.
    void
    flush();

    /// Bring all rows to the disk. Throws ExcUser if that fails.
    void
    sync();

  private:
    std::filesystem::path path_;
    std::ofstream         file_;
    unsigned int          n_columns_ = 0;
    unsigned long         n_bytes_   = 0; // flushed, or at the checkpoint
  };
} // namespace talus

#endif

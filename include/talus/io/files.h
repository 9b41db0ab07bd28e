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
  /// Whether a run begins at the start or continues from a checkpoint.
  enum class Beginning
  {
    fresh,
    resumed
  };



  /// Make the folder and missing parent folders. Throws ExcUser on failure.
  void
  make_folder(const std::filesystem::path &folder);



  /// Register a file that the run reads, for instance the parameters: no output
  /// may overwrite a registered file.
  void
  protect_input(const std::filesystem::path &path);



  /// Return the reason why @p path must not be written, a sentence, if the path
  /// leads to a registered input, under any name; otherwise empty.
  std::string
  clash_with_input(const std::filesystem::path &path);



  /// Throw ExcUser if @p path leads to a registered input.
  void
  check_not_input(const std::filesystem::path &path);



  /// Write the file @p path with the content that @p write puts into the
  /// stream: completely or, with ExcUser, not at all. An older file of the same
  /// name survives a failure. After a crash of the machine the new file may be
  /// empty unless sync_to_disk() was called, which often takes longer than
  /// writing.
  void
  write_file(const std::filesystem::path               &path,
             const std::function<void(std::ostream &)> &write);



  /// Bring the content of a file, or the names in a folder, to the disk.
  /// Returns the reason for a failure, or an empty text.
  std::string
  sync_to_disk(const std::filesystem::path &path);



  /// Return the error message for a file @p path that could not be written.
  std::string
  failed_write(const std::filesystem::path &path, const std::string &reason);



  /// Text file to which lines are appended.
  class LogFile
  {
  public:
    /// Start a new file, or append in a resumed run. Throws ExcUser on failure.
    void
    open(const std::filesystem::path &path,
         Beginning                    beginning = Beginning::fresh);

    /// Append a line immediately. Throws ExcUser on failure.
    void
    add_line(const std::string &line);

  private:
    std::filesystem::path path_;
    std::ofstream         file_;
  };



  /// Return a field of a CSV table: 16 significant digits, or 17 where 16 would
  /// not give @p value back exactly. Empty if @p value is NaN: the quantity has
  /// no value.
  std::string
  csv_field(double value);



  /// Table in a file, to which rows are appended: comma separated, see
  /// csv_field().
  class CsvFile
  {
  public:
    /// Start a new file with a header line; in a resumed run continue after the
    /// rows that the file had at the checkpoint. Throws ExcUser on failure.
    void
    open(const std::filesystem::path    &path,
         const std::vector<std::string> &names,
         Beginning                       beginning = Beginning::fresh);

    /// Return the reason why the resumed run cannot continue the file @p path
    /// with the columns @p names from the loaded checkpoint; otherwise empty.
    std::string
    cannot_resume(const std::filesystem::path    &path,
                  const std::vector<std::string> &names) const;

    /// Add the length of the file to the state of the run.
    void
    list_state(const std::string &name, StateList &list);

    /// Append a row. The row is in the file only after flush().
    void
    add_row(const std::vector<double> &values);

    /// Hand all rows to the operating system, visible for readers during the
    /// run. Throws ExcUser on failure.
    void
    flush();

    /// Bring all rows to the disk, if the file is open on this rank. Throws
    /// ExcUser on failure.
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

#ifndef talus_observers_files_h
#define talus_observers_files_h

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Make the folder (and those above it) unless it is there. Throws ExcUser
  /// if that fails.
  void
  make_folder(const std::filesystem::path &folder);



  /// Make the file @p path from what @p write puts into the stream: all of it
  /// or, with ExcUser, nothing; an older file of that name survives a failure.
  void
  write_file(const std::filesystem::path               &path,
             const std::function<void(std::ostream &)> &write);



  /// The sentence that says that the file @p path could not be written.
  std::string
  failed_write(const std::filesystem::path &path, const std::string &reason);



  /// A text that grows line by line.
  class LogFile
  {
  public:
    /// Start a new file. Throws ExcUser if that fails.
    void
    open(const std::filesystem::path &path);

    /// Append a line, at once. Throws ExcUser if that fails.
    void
    add_line(const std::string &line);

  private:
    std::filesystem::path path_;
    std::ofstream         file_;
  };



  /// A table that grows row by row, comma separated, 16 significant digits.
  class CsvFile
  {
  public:
    /// Start a new file with one header line. Throws ExcUser if that fails.
    void
    open(const std::filesystem::path    &path,
         const std::vector<std::string> &names);

    /// Append a row; it is in the file only after flush().
    void
    add_row(const std::vector<double> &values);

    /// Hand all rows to the operating system, so that a reader sees them while
    /// the simulation runs. Throws ExcUser if that fails.
    void
    flush();

  private:
    std::filesystem::path path_;
    std::ofstream         file_;
    unsigned int          n_columns_ = 0;
  };
} // namespace talus

#endif

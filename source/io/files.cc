// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>

#include <boost/algorithm/string/join.hpp>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the C library's message for errno, which streams set but do not
    /// report. Callers set errno to 0 before the operation, to exclude older
    /// errors.
    std::string
    reason()
    {
      return errno == 0 ? "unknown reason" : std::strerror(errno);
    }



    std::string
    failed_write_by_errno(const std::filesystem::path &path)
    {
      return talus::failed_write(path, reason());
    }



    std::vector<std::filesystem::path> &
    inputs()
    {
      static std::vector<std::filesystem::path> list;
      return list;
    }
  } // namespace



  void
  protect_input(const std::filesystem::path &path)
  {
    inputs().push_back(path);
  }



  // Compares the files, not the names: there may be links.
  std::string
  clash_with_input(const std::filesystem::path &path)
  {
    std::error_code ignored;
    for (const std::filesystem::path &input : inputs())
      if (std::filesystem::equivalent(path, input, ignored))
        return text("The run would write '",
                    path.string(),
                    "', which is also the input '",
                    input.string(),
                    "'. Choose another folder with Output/Folder or --output, "
                    "or give the input another name.");
    return "";
  }



  void
  check_not_input(const std::filesystem::path &path)
  {
    const std::string clash = clash_with_input(path);
    AssertThrow(clash.empty(), ExcUser(clash));
  }



  void
  make_folder(const std::filesystem::path &folder)
  {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    AssertThrow(!error && std::filesystem::is_directory(folder, error),
                ExcUser(text("The output folder '",
                             folder.string(),
                             "' could not be made (",
                             error ? error.message() : "it is not a folder",
                             "). A folder that can be written is expected; "
                             "choose another one with Output/Folder or "
                             "--output.")));
  }



  /// Write a file under another name, then rename: rename() replaces a file
  /// atomically, and a reader, or a run killed in between, finds either the old
  /// file or the complete new file. Any old file under the temporary name is
  /// removed first, because a link could lead to a file of the user. The stream
  /// is closed before the check, since a full disk may show only then.
  void
  write_file(const std::filesystem::path               &path,
             const std::function<void(std::ostream &)> &write)
  {
    std::filesystem::path part = path;
    part += ".part";
    check_not_input(path);
    check_not_input(part);
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    errno = 0;
    std::ofstream file(part, std::ios::binary);
    write(file);
    file.close();
    if (!file)
      {
        const std::string sentence = failed_write_by_errno(path);
        std::filesystem::remove(part, ignored);
        AssertThrow(false, ExcUser(sentence));
      }
    std::error_code error;
    std::filesystem::rename(part, path, error);
    errno = error.value();
    AssertThrow(!error, ExcUser(failed_write_by_errno(path)));
  }



  std::string
  sync_to_disk(const std::filesystem::path &path)
  {
    errno                = 0;
    const int descriptor = ::open(path.c_str(), O_RDONLY);
    // A folder is opened in the same way; syncing a folder preserves the names.
    if (descriptor < 0)
      return reason();
    // Some file systems cannot sync everything, and return EINVAL.
    const bool        is_done = (::fsync(descriptor) == 0 || errno == EINVAL);
    const std::string error   = is_done ? "" : reason();
    ::close(descriptor);
    return error;
  }



  std::string
  failed_write(const std::filesystem::path &path, const std::string &reason)
  {
    return text("The file '",
                path.string(),
                "' could not be written (",
                reason,
                "). Free some space or choose another folder with "
                "Output/Folder or --output.");
  }



  /// A resumed run keeps lines after the checkpoint: the log shows all events.
  void
  LogFile::open(const std::filesystem::path &path, const Beginning beginning)
  {
    check_not_input(path);
    path_ = path;
    errno = 0;
    file_ = std::ofstream(path,
                          beginning == Beginning::fresh ? std::ios::trunc
                                                        : std::ios::app);
    AssertThrow(file_, ExcUser(failed_write_by_errno(path_)));
  }



  void
  LogFile::add_line(const std::string &line)
  {
    errno = 0;
    file_ << line << std::endl;
    AssertThrow(file_, ExcUser(failed_write_by_errno(path_)));
  }



  /// A resumed run cuts the file to the length at the checkpoint, known from
  /// the state. The table is then byte by byte equal to the table of an
  /// uninterrupted run. The file is opened for input, too, as output alone
  /// would empty it.
  void
  CsvFile::open(const std::filesystem::path    &path,
                const std::vector<std::string> &names,
                const Beginning                 beginning)
  {
    check_not_input(path);
    path_      = path;
    n_columns_ = names.size();
    file_.close();
    file_.clear();
    errno = 0;
    if (beginning == Beginning::resumed)
      {
        // Checked before, for all tables, but the file may have changed since,
        // and a file that is too short would be filled up with zeros.
        const std::string sentence = cannot_resume(path, names);
        AssertThrow(sentence.empty(), ExcUser(sentence));
        // Rows after the checkpoint are written again.
        std::error_code error;
        std::filesystem::resize_file(path, n_bytes_, error);
        errno = error.value();
        AssertThrow(!error, ExcUser(failed_write_by_errno(path)));
        file_.open(path, std::ios::in | std::ios::out | std::ios::ate);
        flush();
        return;
      }
    n_bytes_ = 0;
    file_.open(path);
    file_ << boost::algorithm::join(names, ",") << '\n';
    flush();
  }



  /// A longer file is right: the run wrote rows after the checkpoint. All rows
  /// before the checkpoint must be present, with the same columns.
  std::string
  CsvFile::cannot_resume(const std::filesystem::path    &path,
                         const std::vector<std::string> &names) const
  {
    const std::string what =
      "The file '" + path.string() + "', which the run is to go on with, ";
    std::error_code error;
    const auto      size = std::filesystem::file_size(path, error);
    if (error || size < n_bytes_)
      return text(what,
                  error ? "cannot be read (" + error.message() + ")"
                        : text("has only ", size, " bytes"),
                  ", but it had ",
                  n_bytes_,
                  " bytes at the checkpoint. Restore the file of the "
                  "checkpoint, or start the run anew.");

    // Another version of talus may have other columns.
    std::ifstream file(path);
    std::string   header;
    std::getline(file, header);
    std::istringstream columns(header);
    for (const std::string &name : names)
      {
        std::string found;
        std::getline(columns, found, ',');
        if (found != name)
          return what + "has a column '" + found + "' where '" + name +
                 "' was expected. Resume with the version of talus that "
                 "wrote the file, or start the run anew.";
      }
    return "";
  }



  void
  CsvFile::list_state(const std::string &name, StateList &list)
  {
    // The file belongs to the first rank; all higher ranks have zero.
    list.add("length of " + name, "B", n_bytes_, Reduction::sum);
  }



  std::string
  csv_field(const double value)
  {
    if (std::isnan(value))
      return "";
    char number[32];
    for (const char *const digits : {"%.16g", "%.17g"})
      {
        std::snprintf(number, sizeof(number), digits, value);
        if (std::strtod(number, nullptr) == value)
          break;
      }
    return number;
  }



  void
  CsvFile::add_row(const std::vector<double> &values)
  {
    TalusAssert(values.size() == n_columns_,
                ExcDimensionMismatch(values.size(), n_columns_));
    std::string row;
    for (unsigned int i = 0; i < values.size(); ++i)
      row += (i == 0 ? "" : ",") + csv_field(values[i]);
    // A failure here shows in flush().
    file_ << row << '\n';
  }



  namespace
  {
    /// Return whether a file is missing or too short; a device has no length.
    bool
    has_lost(const std::filesystem::path &path, const unsigned long n_bytes)
    {
      std::error_code error;
      const auto      status = std::filesystem::status(path, error);
      return !std::filesystem::exists(status) ||
             (std::filesystem::is_regular_file(status) &&
              std::filesystem::file_size(path, error) < n_bytes);
    }
  } // namespace



  /// n_bytes_ is the length for a checkpoint: bytes handed to the operating
  /// system. The check comes first: new rows behind a cut would hide the loss.
  void
  CsvFile::flush()
  {
    AssertThrow(n_bytes_ == 0 || !has_lost(path_, n_bytes_),
                ExcUser(
                  "The file '" + path_.string() +
                  "', into which the run writes, was removed or cut short by "
                  "another program: the results are not complete. Restore "
                  "the missing part and continue with --resume, or start "
                  "anew with --overwrite."));
    errno = 0;
    file_.flush();
    AssertThrow(file_, ExcUser(failed_write_by_errno(path_)));
    n_bytes_ = file_.tellp();
  }



  void
  CsvFile::sync()
  {
    if (!file_.is_open())
      return;
    flush();
    AssertThrow(sync_to_disk(path_).empty(),
                ExcUser(failed_write_by_errno(path_)));
  }
} // namespace talus

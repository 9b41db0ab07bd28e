// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>

#include <boost/algorithm/string/join.hpp>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <unistd.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// The C library's words for errno, which streams set but do not tell.
    /// Callers set it to 0 before, so that an old error is not taken for
    /// theirs.
    std::string
    reason()
    {
      return errno == 0 ? "unknown reason" : std::strerror(errno);
    }



    std::string
    failed_write(const std::filesystem::path &path)
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



  // By what the file is, not by its name: there may be links.
  std::string
  clash_with_input(const std::filesystem::path &path)
  {
    std::error_code ignored;
    for (const std::filesystem::path &input : inputs())
      if (std::filesystem::equivalent(path, input, ignored))
        return text("The run would write '",
                    path.string(),
                    "', but that is '",
                    input.string(),
                    "', which it reads. Choose another folder with "
                    "Output/Folder or --output, or give the input another "
                    "name.");
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



  /// Under another name first, then renamed: rename() replaces a file at once,
  /// so a reader, and a run that is killed in between, find either the old file
  /// or the whole new one. What has the other name goes: a link would lead to a
  /// file of the user. It is closed before it is looked at, since a full
  /// disk may show only there.
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
        const std::string sentence = failed_write(path);
        std::filesystem::remove(part, ignored);
        AssertThrow(false, ExcUser(sentence));
      }
    std::error_code error;
    std::filesystem::rename(part, path, error);
    errno = error.value();
    AssertThrow(!error, ExcUser(failed_write(path)));
  }



  std::string
  sync_to_disk(const std::filesystem::path &path)
  {
    errno                = 0;
    const int descriptor = ::open(path.c_str(), O_RDONLY);
    // A folder is opened in the same way: to sync it keeps its names.
    if (descriptor < 0)
      return reason();
    // Some file systems cannot sync everything, and say so with EINVAL.
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



  /// Lines after the checkpoint are kept in a resumed run: they tell what
  /// happened.
  void
  LogFile::open(const std::filesystem::path &path, const Beginning beginning)
  {
    check_not_input(path);
    path_ = path;
    errno = 0;
    file_ = std::ofstream(path,
                          beginning == Beginning::fresh ? std::ios::trunc
                                                        : std::ios::app);
    AssertThrow(file_, ExcUser(failed_write(path_)));
  }



  void
  LogFile::add_line(const std::string &line)
  {
    errno = 0;
    file_ << line << std::endl;
    AssertThrow(file_, ExcUser(failed_write(path_)));
  }



  /// A resumed run cuts the file to the length that it had at the checkpoint,
  /// known from the state: then the table is byte by byte that of a run without
  /// a stop. Opened for input, too, as output alone would empty the file.
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
        // Asked before, for all tables, but it may have changed since; and what
        // is too short would be filled up with zeros.
        const std::string sentence = cannot_resume(path, names);
        AssertThrow(sentence.empty(), ExcUser(sentence));
        // Rows written after the checkpoint are written once more.
        std::error_code error;
        std::filesystem::resize_file(path, n_bytes_, error);
        errno = error.value();
        AssertThrow(!error, ExcUser(failed_write(path)));
        file_.open(path, std::ios::in | std::ios::out | std::ios::ate);
        flush();
        return;
      }
    n_bytes_ = 0;
    file_.open(path);
    file_ << boost::algorithm::join(names, ",") << '\n';
    flush();
  }



  /// A longer file is right: rows were written after the checkpoint. What
  /// matters is that nothing before it is missing, and that the columns are the
  /// same.
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
                  " bytes at the checkpoint. Put back the file that belongs to "
                  "the checkpoint, or start the run anew.");

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
                 "' was expected. Resume with the version of talus that wrote "
                 "it, or start the run anew.";
      }
    return "";
  }



  void
  CsvFile::list_state(const std::string &name, StateList &list)
  {
    // The file belongs to the first rank; the others have zero.
    list.add("length of " + name, "B", n_bytes_, Reduction::sum);
  }



  std::string
  csv_field(const double value)
  {
    if (std::isnan(value))
      return "";
    char number[32];
    std::snprintf(number, sizeof(number), "%.16g", value);
    return number;
  }



  void
  CsvFile::add_row(const std::vector<double> &values)
  {
    Assert(values.size() == n_columns_,
           ExcDimensionMismatch(values.size(), n_columns_));
    std::string row;
    for (unsigned int i = 0; i < values.size(); ++i)
      row += (i == 0 ? "" : ",") + csv_field(values[i]);
    // A failure here shows in flush().
    file_ << row << '\n';
  }



  namespace
  {
    /// Whether a file is not there or too short; a device has no length.
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



  /// n_bytes_ is what a checkpoint would save: bytes that the operating system
  /// has. Looked at before: rows behind a cut would hide it.
  void
  CsvFile::flush()
  {
    AssertThrow(n_bytes_ == 0 || !has_lost(path_, n_bytes_),
                ExcUser("The file '" + path_.string() +
                        "', into which the run writes, was removed or cut "
                        "short by someone else, so that its results are not "
                        "complete. Put back what is missing and go on with "
                        "--resume, or start anew with --overwrite."));
    errno = 0;
    file_.flush();
    AssertThrow(file_, ExcUser(failed_write(path_)));
    n_bytes_ = file_.tellp();
  }



  void
  CsvFile::sync()
  {
    flush();
    AssertThrow(sync_to_disk(path_).empty(), ExcUser(failed_write(path_)));
  }
} // namespace talus

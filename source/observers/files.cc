#include <talus/base/errors.h>
#include <talus/observers/files.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
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
  } // namespace



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



  void
  write_file(const std::filesystem::path               &path,
             const std::function<void(std::ostream &)> &write)
  {
    // Through memory, because deal.II's writers throw errors of their own at a
    // stream that failed, and they do not know the name of the file.
    std::stringstream content;
    write(content);

    std::filesystem::path part = path;
    part += ".part";
    errno = 0;
    std::ofstream file(part, std::ios::binary);
    file << content.rdbuf();
    file.close();
    if (!file)
      {
        const std::string sentence = failed_write(path);
        std::error_code   ignored;
        std::filesystem::remove(part, ignored);
        AssertThrow(false, ExcUser(sentence));
      }
    std::error_code error;
    std::filesystem::rename(part, path, error);
    errno = error.value();
    AssertThrow(!error, ExcUser(failed_write(path)));
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



  void
  LogFile::open(const std::filesystem::path &path)
  {
    path_ = path;
    errno = 0;
    file_ = std::ofstream(path);
    AssertThrow(file_, ExcUser(failed_write(path_)));
  }



  void
  LogFile::add_line(const std::string &line)
  {
    errno = 0;
    file_ << line << std::endl;
    AssertThrow(file_, ExcUser(failed_write(path_)));
  }



  void
  CsvFile::open(const std::filesystem::path    &path,
                const std::vector<std::string> &names)
  {
    path_      = path;
    n_columns_ = names.size();
    file_.close();
    file_.clear();
    errno = 0;
    file_.open(path);
    for (unsigned int i = 0; i < names.size(); ++i)
      file_ << (i == 0 ? "" : ",") << names[i];
    file_ << '\n';
    flush();
  }



  void
  CsvFile::add_row(const std::vector<double> &values)
  {
    Assert(values.size() == n_columns_,
           ExcDimensionMismatch(values.size(), n_columns_));
    std::string row;
    char        number[32];
    for (const double value : values)
      {
        std::snprintf(number, sizeof(number), "%.16g", value);
        row += (row.empty() ? "" : ",");
        row += number;
      }
    // A failure here shows in flush().
    file_ << row << '\n';
  }



  void
  CsvFile::flush()
  {
    errno = 0;
    file_.flush();
    AssertThrow(file_, ExcUser(failed_write(path_)));
  }
} // namespace talus

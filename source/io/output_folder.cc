// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>

#include <boost/algorithm/string/predicate.hpp>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <regex>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string other_folder =
      ", or choose another folder with Output/Folder or --output.";

    const std::string begin_of_lock = "on host '";



    /// Return the first 256 bytes of the open lock @p file: host and process of
    /// the owner.
    std::string
    content_of(const int file)
    {
      std::array<char, 256> buffer;
      const ssize_t         n = ::pread(file, buffer.data(), buffer.size(), 0);
      return {buffer.data(), static_cast<std::size_t>(n > 0 ? n : 0)};
    }



    /// Return whether only talus has written into the lock.
    bool
    is_ours(const std::string &content)
    {
      return content.empty() || boost::starts_with(content, begin_of_lock);
    }



    /// Return a sentence that the output folder holds @p what.
    template <typename... Arguments>
    std::string
    folder_holds(const fs::path &folder, const Arguments &...what)
    {
      return text("The output folder '", folder.string(), "' holds ", what...);
    }



    std::string
    lock_of_others(const fs::path &folder)
    {
      return folder_holds(folder,
                          "a file 'lock' that no run has written, and this "
                          "run would write over the file. Move the file",
                          other_folder);
    }



    /// Lock the folder. Returns the reason for a failure, or an empty text. A
    /// link is not followed: the target may be a file of the user.
    std::string
    lock(const fs::path &folder, int &file)
    {
      const fs::path path = folder / "lock";
      file =
        ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (file < 0)
        return errno == ELOOP ? lock_of_others(folder)
                              : failed_write(path, std::strerror(errno));
      const std::string owner = content_of(file);
      if (::flock(file, LOCK_EX | LOCK_NB) != 0)
        return errno != EWOULDBLOCK
                 ? ""
                 : text("The output folder '",
                        folder.string(),
                        "' belongs to another run, which runs ",
                        owner.empty() ? "somewhere" : owner,
                        ". Wait for the end of the other run",
                        other_folder);
      if (!is_ours(owner))
        return lock_of_others(folder);
      // A refused run may have removed the file before it was locked here.
      struct stat status;
      if (::fstat(file, &status) == 0 && status.st_nlink == 0)
        {
          ::close(file);
          return lock(folder, file);
        }
      // The lock alone decides. The content only names the owner, and may be
      // missing, for instance on a full disk.
      std::array<char, 256> host = {};
      ::gethostname(host.data(), host.size() - 1);
      const std::string content =
        text(begin_of_lock, host.data(), "' as process ", ::getpid());
      [[maybe_unused]] const bool is_written =
        ::ftruncate(file, 0) == 0 &&
        ::pwrite(file, content.data(), content.size(), 0) > 0;
      return "";
    }



    /// Return whether the folder holds a `lock` that talus has not written: a
    /// link or a folder, too. O_NONBLOCK, because opening a pipe would wait for
    /// a writer.
    bool
    has_foreign_lock(const fs::path &folder)
    {
      const int file = ::open((folder / "lock").c_str(),
                              O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
      if (file < 0)
        return errno != ENOENT;
      struct stat status;
      const bool  is_foreign = ::fstat(file, &status) != 0 ||
                              !S_ISREG(status.st_mode) ||
                              !is_ours(content_of(file));
      ::close(file);
      return is_foreign;
    }
  } // namespace



  // flock(), not fcntl(): the lock belongs to the open file, and is not lost
  // when the program closes another descriptor of the same file. The file stays
  // after the run, as the resumed run and the tools look for it.
  void
  FolderLock::acquire(const fs::path &folder, const MPI_Comm communicator)
  {
    std::string error;
    if (is_first_rank(communicator))
      {
        make_folder(folder);
        const bool is_new = !fs::exists(fs::symlink_status(folder / "lock"));
        error             = lock(folder, file_);
        if (is_new && error.empty())
          new_file_ = folder / "lock";
      }
    error = Utilities::MPI::broadcast(communicator, error);
    AssertThrow(error.empty(), ExcUser(error));
  }



  FolderLock::~FolderLock()
  {
    std::error_code ignored;
    if (!new_file_.empty())
      fs::remove(new_file_, ignored);
    if (file_ >= 0)
      ::close(file_);
  }



  namespace
  {
    /// Return whether a run may write a file of the given name. All names are
    /// listed here, not with the writers: an earlier run may have written files
    /// that the present run does not write.
    bool
    is_output_name(const std::string &file_name)
    {
      static const std::regex names(
        "(statistics|profile|obstacles|boundaries|newton|maps|stations|lines|"
        "runout|plan|plan-cells|tsunami-source)\\.csv|plan-cells\\.prj|tsunami-"
        "source\\.(tt3|nc)|log\\.txt|"
        "parameters\\.prm|maps\\.vtu|"
        "maps/(ground|erosion|thickness-at-start|final-(thickness|mass)|"
        "(time-of-)?maximum-(thickness|speed|momentum-flux|bed-shear)|"
        "arrival-time-[-+.0-9e]*-m)\\.(asc|prj|tif)|"
        "(points|grid|facets|obstacles|mechanism|no-equilibrium|last-state)"
        "([-.][-.0-9]*)?\\.(vtu|pvtu|pvd|h5|xdmf)");
      return std::regex_match(file_name, names);
    }



    /// Return the files of @p type in a folder, or links to files of @p type,
    /// that are named as outputs followed by @p ending.
    std::vector<fs::path>
    outputs_in(const fs::path     &folder,
               const std::string  &ending = "",
               const fs::file_type type   = fs::file_type::regular)
    {
      std::vector<fs::path> result;
      for (const std::string within : {"", "maps/"})
        {
          std::error_code error, ignored;
          for (fs::directory_iterator entry(folder / within, error), end;
               !error && entry != end;
               entry.increment(error))
            if (const std::string name = entry->path().filename().string();
                entry->status(ignored).type() == type &&
                boost::ends_with(name, ending) &&
                is_output_name(within +
                               name.substr(0, name.size() - ending.size())))
              result.push_back(entry->path());
        }
      return result;
    }



    /// Return whether a folder can be written, by making and removing a
    /// subfolder: permissions are no answer for root, nor on file systems
    /// without new files, for instance /proc.
    bool
    can_hold_folders(const fs::path &folder)
    {
      std::string name = (folder / ".talus-XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr)
        return false;
      std::error_code error;
      return fs::remove(name, error);
    }
  } // namespace



  // Checks the existing part of the path.
  void
  check_can_be_made(const fs::path &folder)
  {
    std::error_code error;
    fs::path        there = fs::absolute(folder, error);
    while (there.has_relative_path() && !fs::exists(there, error))
      there = there.parent_path();
    const bool is_folder = fs::is_directory(there, error);
    AssertThrow(is_folder && can_hold_folders(there),
                ExcUser(
                  text("The output folder '",
                       folder.string(),
                       "' cannot be made or written ('",
                       there.string(),
                       is_folder ? "' cannot be written" : "' is not a folder",
                       "). Choose another one with Output/Folder or "
                       "--output.")));
  }



  std::string
  foreign_file(const fs::path &folder, const Beginning beginning)
  {
    // Opening a pipe would wait for a reader.
    if (const auto pipes = outputs_in(folder, "", fs::file_type::fifo);
        !pipes.empty())
      return folder_holds(folder,
                          "a pipe '",
                          pipes.front().string(),
                          "', where the run writes a file of the same name. "
                          "Remove the pipe",
                          other_folder);
    if (has_foreign_lock(folder))
      return lock_of_others(folder);
    const auto results = outputs_in(folder);
    // write_file() makes the file under another name first.
    for (const auto &paths : {results, outputs_in(folder, ".part")})
      for (const fs::path &path : paths)
        if (const std::string clash = clash_with_input(path); !clash.empty())
          return clash;
    const fs::path record = folder / "parameters.prm";
    if (is_run_record(record))
      return "";
    if (fs::symlink_status(record).type() != fs::file_type::not_found)
      return folder_holds(
        folder,
        "a file 'parameters.prm' that no run has written or somebody has "
        "changed, and this run would write over the file. Move the file",
        beginning == Beginning::resumed
          ? ", and resume with the moved file or another parameter file."
          : other_folder);
    return beginning == Beginning::resumed || results.empty()
             ? ""
             : folder_holds(folder,
                            "'",
                            results.front().string(),
                            "', named like the output of a run, but no "
                            "'parameters.prm' of a run: the file may be yours. "
                            "Move the file",
                            other_folder);
  }



  void
  remove_results(const fs::path &folder, const Beginning beginning)
  {
    for (const std::string ending : {"", ".part"})
      for (const fs::path &path : outputs_in(folder, ending))
        {
          const std::string name = path.filename().string();
          if (beginning == Beginning::resumed
                ? ending.empty() && !boost::starts_with(name, "last-state")
                : name == "parameters.prm")
            continue;
          std::error_code error;
          fs::remove(path, error);
          AssertThrow(!error,
                      ExcUser(text("The file '",
                                   path.string(),
                                   "' of an earlier run could not be removed (",
                                   error.message(),
                                   "). Remove the file",
                                   other_folder)));
        }
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/folder_lock.h>

#include <array>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace talus
{
  using namespace dealii;

  FolderLock::~FolderLock()
  {
    if (file_ >= 0)
      ::close(file_);
  }



  namespace
  {
    /// Return the first 256 bytes of the lock, with the name of the owner.
    std::string
    content_of(const int file)
    {
      std::array<char, 256> buffer;
      const ssize_t         n = ::pread(file, buffer.data(), buffer.size(), 0);
      return {buffer.data(), static_cast<std::size_t>(n > 0 ? n : 0)};
    }



    const std::string first_words = "on host '";

    std::string
    process_on_host()
    {
      std::array<char, 256> name = {};
      ::gethostname(name.data(), name.size() - 1);
      return text(first_words, name.data(), "' as process ", ::getpid());
    }



    /// Return whether only talus has written into the lock.
    bool
    is_ours(const std::string &content)
    {
      return content.compare(0, first_words.size(), first_words) == 0 ||
             content.empty();
    }



    std::string
    lock_of_others(const std::filesystem::path &path)
    {
      return text("The output folder '",
                  path.parent_path().string(),
                  "' holds a file 'lock' that no run has written, and this "
                  "run would write over the file. Move the file, or choose "
                  "another folder with Output/Folder or --output.");
    }



    std::string
    other_run(const std::filesystem::path &path, const std::string &owner)
    {
      return text("The output folder '",
                  path.parent_path().string(),
                  "' belongs to another run, which runs ",
                  owner.empty() ? "somewhere" : owner,
                  ". Wait for the end of the other run, or choose another "
                  "folder with Output/Folder or --output.");
    }



    /// Lock @p path. Returns the reason for a failure, or an empty text. Links
    /// are not followed: the target may be a file of the user.
    std::string
    lock(const std::filesystem::path &path, int &file)
    {
      file =
        ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (file < 0)
        return errno == ELOOP ? lock_of_others(path)
                              : talus::failed_write(path, std::strerror(errno));
      if (::flock(file, LOCK_EX | LOCK_NB) != 0)
        return errno == EWOULDBLOCK ? other_run(path, content_of(file)) : "";
      if (!is_ours(content_of(file)))
        return lock_of_others(path);
      // The lock alone decides. The content only names the owner, and may be
      // missing, for instance on a full disk.
      const std::string           content = process_on_host();
      [[maybe_unused]] const bool is_written =
        ::ftruncate(file, 0) == 0 &&
        ::pwrite(file, content.data(), content.size(), 0) > 0;
      return "";
    }
  } // namespace



  // Neither a link, which open() refuses, nor a folder belongs to a run.
  // O_NONBLOCK, because opening a pipe would wait for a writer.
  std::string
  foreign_lock(const std::filesystem::path &folder)
  {
    const std::filesystem::path path = folder / "lock";
    const int                   file =
      ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0)
      return errno == ENOENT ? "" : lock_of_others(path);
    struct stat status;
    const bool  is_foreign = ::fstat(file, &status) != 0 ||
                            !S_ISREG(status.st_mode) ||
                            !is_ours(content_of(file));
    ::close(file);
    return is_foreign ? lock_of_others(path) : "";
  }



  // flock(), not fcntl(): the lock belongs to the open file, and is not lost
  // when the program closes another descriptor of the same file. The file stays
  // after the run: removing it could remove the lock of a run that starts at
  // the same moment.
  void
  FolderLock::acquire(const std::filesystem::path &folder,
                      const MPI_Comm               communicator)
  {
    std::string error;
    if (is_first_rank(communicator))
      {
        make_folder(folder);
        error = lock(folder / "lock", file_);
      }
    error = Utilities::MPI::broadcast(communicator, error);
    AssertThrow(error.empty(), ExcUser(error));
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/io/files.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    const std::string part_ending = ".part";

    /// Enough digits that the names sort in the order of the steps.
    constexpr unsigned int n_digits = 10;

    /// Folder of all checkpoints, separate from other output.
    fs::path
    folder_of_all(const fs::path &output_folder)
    {
      return output_folder / "checkpoints";
    }



    /// Whether @p path is a file of a checkpoint or a hidden file of Open MPI
    /// (".mesh.shfp.<job>.<number>"). Open MPI keeps the shared file pointer of
    /// an open file in a hidden file, which remains if the run is killed.
    bool
    is_file_of_checkpoint(const fs::path &path)
    {
      const std::string name = path.filename().string();
      const auto        end  = name.find(".shfp.");
      return is_checkpoint_file(name) ||
             (name.front() == '.' && end != std::string::npos &&
              is_checkpoint_file(name.substr(1, end - 1)));
    }



    /// List the entries of a folder; empty if the folder does not exist.
    std::vector<fs::path>
    content(const fs::path &folder)
    {
      // Without exceptions: a missing folder, also one removed meanwhile, is
      // empty.
      std::vector<fs::path> result;
      std::error_code       error;
      for (fs::directory_iterator entry(folder, error), end;
           !error && entry != end;
           entry.increment(error))
        result.push_back(entry->path());
      return result;
    }



    /// Whether @p path may be a checkpoint: @p name is a step as in
    /// checkpoint_path(), and the folder contains files of a checkpoint or no
    /// files. All other folders belong to the user.
    bool
    is_checkpoint(const fs::path &path, const std::string &name)
    {
      std::error_code error;
      if (name.size() < n_digits ||
          (name.size() > n_digits && name.front() == '0') ||
          name.find_first_not_of("0123456789") != std::string::npos ||
          !fs::is_directory(fs::symlink_status(path, error)))
        return false;
      const std::vector<fs::path> files = content(path);
      return files.empty() ||
             std::any_of(files.begin(), files.end(), is_file_of_checkpoint);
    }



    bool
    is_unfinished(const fs::path &path)
    {
      return path.extension() == part_ending &&
             is_checkpoint(path, path.stem().string());
    }



    /// Remove the files of a checkpoint, and the folder if it is empty then.
    /// The state is removed first: a partly removed checkpoint without state is
    /// damaged, and without the mesh it is no checkpoint any more.
    std::error_code
    remove_checkpoint(const fs::path &path)
    {
      std::error_code error;
      if (!fs::is_directory(fs::symlink_status(path, error)))
        return {};
      std::vector<fs::path> files = content(path);
      std::sort(files.rbegin(), files.rend());
      for (const fs::path &file : files)
        if (is_file_of_checkpoint(file) && !fs::remove(file, error) && error)
          return error;
      if (content(path).empty())
        fs::remove(path, error);
      return error;
    }



    /// Move files into an existing folder that must not be replaced, because it
    /// contains files of the user. The state is moved last: until then the
    /// checkpoint is damaged, like a partly removed one.
    std::error_code
    move_files(const fs::path &from, const fs::path &to)
    {
      std::error_code       error;
      std::vector<fs::path> files = content(from);
      std::sort(files.begin(), files.end());
      for (const fs::path &file : files)
        if (fs::rename(file, to / file.filename(), error); error)
          return error;
      if (!sync_to_disk(to).empty())
        return std::make_error_code(std::errc::io_error);
      fs::remove(from, error);
      return error;
    }



    bool
    has_foreign_files(const fs::path &checkpoint)
    {
      const std::vector<fs::path> files = content(checkpoint);
      return !std::all_of(files.begin(), files.end(), is_file_of_checkpoint);
    }



    /// All ranks get the list of the first rank, since file systems may show
    /// different states.
    std::vector<fs::path>
    list_for_all_ranks(const fs::path &output_folder,
                       const MPI_Comm  communicator)
    {
      std::vector<std::string> names;
      if (is_first_rank(communicator))
        for (const fs::path &path : find_checkpoints(output_folder))
          names.push_back(path.string());
      names = Utilities::MPI::broadcast(communicator, names);
      return {names.begin(), names.end()};
    }



    /// Throw ExcUser if the dimension is wrong, which older checkpoints could
    /// not repair.
    void
    check_dimension(const fs::path       &checkpoint,
                    const CheckpointHead &head,
                    const unsigned int    dimension)
    {
      AssertThrow(head.dimension == dimension,
                  ExcUser(text("The checkpoint '",
                               checkpoint.string(),
                               "' is of a run with Dimension = ",
                               head.dimension,
                               ", but Dimension = ",
                               dimension,
                               " was given. Use the parameters of the run to "
                               "resume, or another output folder.")));
    }
  } // namespace



  fs::path
  checkpoint_path(const fs::path &output_folder, const unsigned long step)
  {
    return folder_of_all(output_folder) / Utilities::to_string(step, n_digits);
  }



  fs::path
  temporary_path(const fs::path &checkpoint)
  {
    return checkpoint.string() + part_ending;
  }



  /// Names have leading zeros: the greatest name is the newest checkpoint.
  std::vector<fs::path>
  find_checkpoints(const fs::path &output_folder)
  {
    std::vector<fs::path> result;
    for (const fs::path &path : content(folder_of_all(output_folder)))
      if (is_checkpoint(path, path.filename().string()))
        result.push_back(path);
    std::sort(result.rbegin(), result.rend());
    return result;
  }



  void
  remove_unfinished(const fs::path &output_folder)
  {
    for (const fs::path &path : content(folder_of_all(output_folder)))
      if (is_unfinished(path))
        remove_checkpoint(path);
  }



  std::string
  make_temporary_folder(const fs::path &checkpoint)
  {
    const fs::path  part  = temporary_path(checkpoint);
    std::error_code error = remove_checkpoint(part);
    if (!error && fs::exists(part, error))
      return text("'", part.string(), "' exists and is not a checkpoint");
    if (!error)
      fs::create_directories(part, error);
    return error ? error.message() : "";
  }



  /// Flush the content of the files first, then the directory entries.
  std::string
  sync_folder(const fs::path &folder)
  {
    for (const fs::path &path : content(folder))
      if (const std::string error = sync_to_disk(path); !error.empty())
        return error;
    return sync_to_disk(folder);
  }



  /// A rename is on disk only after the folder is flushed. The folder itself
  /// may be new in the output folder, so both are flushed.
  std::string
  commit(const fs::path &checkpoint)
  {
    // A damaged checkpoint of the same step exists if the run resumed from the
    // previous checkpoint.
    const fs::path  part  = temporary_path(checkpoint);
    std::error_code error = remove_checkpoint(checkpoint);
    std::error_code ignored;
    if (!error && fs::is_directory(checkpoint, ignored))
      error = move_files(part, checkpoint);
    else if (!error)
      fs::rename(part, checkpoint, error);
    if (error)
      return error.message();
    const fs::path    parent  = checkpoint.parent_path();
    const std::string failure = sync_to_disk(parent);
    return failure.empty() ? sync_to_disk(parent.parent_path()) : failure;
  }



  void
  remove_checkpoints_but(const fs::path              &output_folder,
                         const std::vector<fs::path> &kept)
  {
    std::error_code ignored;
    for (const fs::path &path : find_checkpoints(output_folder))
      if (std::find(kept.begin(), kept.end(), path) == kept.end())
        {
          // Renamed first: a partly removed checkpoint must not count as one.
          const fs::path part =
            has_foreign_files(path) ? path : temporary_path(path);
          fs::rename(path, part, ignored);
          remove_checkpoint(part);
        }
  }



  /// Checkpoints are tried from the newest on; damaged ones (such as incomplete
  /// copies) are listed for the log. Another format or dimension ends the
  /// search: older checkpoints are of the same run.
  FoundCheckpoint
  find_checkpoint(const fs::path    &output_folder,
                  const unsigned int dimension,
                  const MPI_Comm     communicator)
  {
    FoundCheckpoint found;
    for (const fs::path &path : list_for_all_ranks(output_folder, communicator))
      {
        const std::string damage = find_damage(path, communicator);
        if (damage.empty())
          {
            found.path = path;
            found.head = load_head(open_state(path, communicator));
            check_dimension(path, found.head, dimension);
            return found;
          }
        found.errors.push_back("The checkpoint '" + path.string() +
                               "' is damaged: " + damage + ".");
      }
    std::string all;
    for (const std::string &error : found.errors)
      all += error + ' ';
    AssertThrow(false,
                ExcUser(
                  all.empty()
                    ? "There is no checkpoint in '" + output_folder.string() +
                        "' to resume from. Name the output folder of the "
                        "run with Output/Folder or --output, or start the "
                        "run without --resume."
                    : all + "There is no other checkpoint to resume from. "
                            "Start a new run with --overwrite."));
    return found;
  }



  /// The newest checkpoint decides: a finished run has a checkpoint at its end
  /// time, if requested. An unreadable checkpoint counts as unfinished, since
  /// its content is unknown.
  void
  check_nothing_unfinished(const fs::path &output_folder,
                           const MPI_Comm  communicator)
  {
    const auto all = list_for_all_ranks(output_folder, communicator);
    if (all.empty())
      return;
    const bool is_readable    = find_damage(all[0], communicator).empty();
    const CheckpointHead head = is_readable
                                  ? load_head(open_state(all[0], communicator))
                                  : CheckpointHead();
    AssertThrow(
      is_readable && head.time >= head.end_time,
      ExcUser(text(
        "The output folder '",
        output_folder.string(),
        "' holds the checkpoint '",
        all[0].filename().string(),
        "' ",
        is_readable
          ? text("at t = ", head.time, " s of a run to ", head.end_time, " s")
          : "of a run, which cannot be read",
        ". Continue the run with --resume, or overwrite it with --overwrite, "
        "or choose another folder with --output.")));
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/checkpoint/damage.h>
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

    /// As many digits as keep the order of the names that of the steps.
    constexpr unsigned int n_digits = 10;

    /// In a folder of their own, so that nothing else in the output folder is
    /// touched.
    fs::path
    folder_of_all(const fs::path &output_folder)
    {
      return output_folder / "checkpoints";
    }



    /// The files of a checkpoint: the state, and what deal.II writes of a mesh.
    bool
    is_written_by_us(const std::string &name)
    {
      return name == state_file_name || is_mesh_file(name);
    }



    /// Open MPI keeps the file pointer that all ranks share in a hidden file
    /// (".mesh.shfp.<job>.<number>") beside each file that it has open; it
    /// stays if the run is killed at that moment.
    bool
    is_file_of_checkpoint(const fs::path &path)
    {
      const std::string name = path.filename().string();
      const auto        end  = name.find(".shfp.");
      return is_written_by_us(name) ||
             (name.front() == '.' && end != std::string::npos &&
              is_written_by_us(name.substr(1, end - 1)));
    }



    /// What is in a folder; nothing if there is no such folder.
    std::vector<fs::path>
    content(const fs::path &folder)
    {
      // Without exceptions: a folder that is not there, or goes meanwhile, has
      // nothing.
      std::vector<fs::path> result;
      std::error_code       error;
      for (fs::directory_iterator entry(folder, error), end;
           !error && entry != end;
           entry.increment(error))
        result.push_back(entry->path());
      return result;
    }



    /// Whether @p path may be a checkpoint, by @p name: that of a step as
    /// checkpoint_path() makes it, and files of ours within, or none. Anything
    /// else in the folder is somebody else's, and stays as it is.
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



    /// Remove a checkpoint but for what others have put into its folder. The
    /// state goes first: without it a half-removed one is damaged, and is no
    /// checkpoint once the mesh has gone, too.
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



    /// Into a folder that is there, as others have files in it, and may not be
    /// replaced. The state comes last: until then it is damaged, as one is that
    /// is removed half.
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



    /// All ranks must see the same, whatever their file systems show them.
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



    /// Throw where no older checkpoint would do either.
    void
    check_kind(const fs::path       &checkpoint,
               const CheckpointHead &head,
               const unsigned int    dimension)
    {
      AssertThrow(head.format == checkpoint_format,
                  ExcUser(text("The checkpoint '",
                               checkpoint.string(),
                               "' has the format version ",
                               head.format,
                               ", but this talus reads version ",
                               checkpoint_format,
                               ". Resume with the version of talus that wrote "
                               "it.")));
      AssertThrow(head.dimension == dimension,
                  ExcUser(text("The checkpoint '",
                               checkpoint.string(),
                               "' is of a run with Dimension = ",
                               head.dimension,
                               ", but Dimension = ",
                               dimension,
                               " was given. Give the parameters of that run, "
                               "or another output folder.")));
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



  /// By name, which has leading zeros, so that the greatest is the newest.
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
      return text("'", part.string(), "' is there and no checkpoint");
    if (!error)
      fs::create_directories(part, error);
    return error ? error.message() : "";
  }



  /// First the content of the files, then their names.
  std::string
  sync_folder(const fs::path &folder)
  {
    for (const fs::path &path : content(folder))
      if (const std::string error = sync_to_disk(path); !error.empty())
        return error;
    return sync_to_disk(folder);
  }



  /// A rename is on the disk only when the folder is, and that folder may
  /// itself be new in the output folder: so both are synced.
  std::string
  commit(const fs::path &checkpoint)
  {
    // One of the same step is there if it was damaged and the run resumed from
    // the one before.
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
          // Under another name first: a half-removed one is none.
          const fs::path part =
            has_foreign_files(path) ? path : temporary_path(path);
          fs::rename(path, part, ignored);
          remove_checkpoint(part);
        }
  }



  /// From the newest on; one that is damaged (as a copy that was cut off) is
  /// noted for the log and the one before it is tried. Another format or
  /// dimension ends the search: older ones are of the same run.
  FoundCheckpoint
  find_checkpoint(const fs::path    &output_folder,
                  const unsigned int dimension,
                  const MPI_Comm     communicator)
  {
    FoundCheckpoint found;
    for (const fs::path &path : list_for_all_ranks(output_folder, communicator))
      {
        Hdf5InputFile file(path / state_file_name, communicator);
        found.head = load_head(file);
        if (file.error().empty())
          check_kind(path, found.head, dimension);
        const std::string damage = find_damage(file, found.head);
        if (damage.empty())
          {
            found.path = path;
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
                    : all + "There is no other one to resume from. Start "
                            "the run anew with --overwrite."));
    return found;
  }



  /// The newest one tells: a run that reached its end has a checkpoint at that
  /// time, if it was asked for. One that cannot be read counts as unfinished,
  /// since nobody knows what it holds.
  void
  check_nothing_unfinished(const fs::path &output_folder,
                           const MPI_Comm  communicator)
  {
    const auto all = list_for_all_ranks(output_folder, communicator);
    if (all.empty())
      return;
    Hdf5InputFile        file(all[0] / state_file_name, communicator);
    const CheckpointHead head = load_head(file);
    const bool           is_readable =
      file.error().empty() && head.format == checkpoint_format;
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
        ". Go on with that run with --resume, or start "
        "anew over it with --overwrite, or choose another "
        "folder with --output.")));
  }
} // namespace talus

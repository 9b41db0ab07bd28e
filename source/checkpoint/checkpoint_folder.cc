#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/io/files.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  namespace fs = std::filesystem;

  namespace
  {
    const std::string part_ending = ".part";

    fs::path
    folder_of_all(const fs::path &output_folder)
    {
      return output_folder / "checkpoints";
    }



    bool
    is_checkpoint(const fs::path &path)
    {
      const std::string name = path.filename().string();
      return !name.empty() &&
             name.find_first_not_of("0123456789") == std::string::npos;
    }



    /// What is in a folder; nothing if there is no such folder.
    std::vector<fs::path>
    content(const fs::path &folder)
    {
      std::vector<fs::path> result;
      std::error_code       error;
      for (fs::directory_iterator entry(folder, error), end;
           !error && entry != end;
           entry.increment(error))
        result.push_back(entry->path());
      return result;
    }
  } // namespace



  fs::path
  checkpoint_path(const fs::path &output_folder, const unsigned long step)
  {
    // As many digits as keep the order of the names that of the steps.
    return folder_of_all(output_folder) /
           dealii::Utilities::to_string(step, 10);
  }



  fs::path
  part_of(const fs::path &checkpoint)
  {
    return checkpoint.string() + part_ending;
  }



  std::vector<fs::path>
  find_checkpoints(const fs::path &output_folder)
  {
    std::vector<fs::path> result;
    for (const fs::path &path : content(folder_of_all(output_folder)))
      if (is_checkpoint(path))
        result.push_back(path);
    std::sort(result.rbegin(), result.rend());
    return result;
  }



  void
  remove_parts(const fs::path &output_folder)
  {
    std::error_code ignored;
    for (const fs::path &path : content(folder_of_all(output_folder)))
      if (path.extension() == part_ending)
        fs::remove_all(path, ignored);
  }



  std::string
  make_part(const fs::path &checkpoint)
  {
    const fs::path  part = part_of(checkpoint);
    std::error_code error;
    fs::remove_all(part, error);
    if (!error)
      fs::create_directories(part, error);
    return error ? error.message() : "";
  }



  std::string
  sync_folder(const fs::path &folder)
  {
    for (const fs::path &path : content(folder))
      if (const std::string complaint = sync_to_disk(path); !complaint.empty())
        return complaint;
    return sync_to_disk(folder);
  }



  std::string
  publish(const fs::path &checkpoint)
  {
    // One of the same step is there if it was damaged and the run resumed from
    // the one before.
    std::error_code error;
    fs::remove_all(checkpoint, error);
    if (!error)
      fs::rename(part_of(checkpoint), checkpoint, error);
    if (error)
      return error.message();
    const std::string complaint = sync_to_disk(checkpoint.parent_path());
    return complaint.empty()
             ? sync_to_disk(checkpoint.parent_path().parent_path())
             : complaint;
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
          fs::rename(path, part_of(path), ignored);
          fs::remove_all(part_of(path), ignored);
        }
  }
} // namespace talus

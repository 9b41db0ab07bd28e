#ifndef talus_checkpoint_checkpoint_folder_h
#define talus_checkpoint_checkpoint_folder_h

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  // A checkpoint is a folder `checkpoints/STEP` in the output folder. It is
  // written under another name and renamed when it is complete and on the disk,
  // so that whatever has a proper name is whole. What follows is done by one
  // rank; functions that may fail return why, empty if they did not.

  /// The folder of the checkpoint of step @p step.
  std::filesystem::path
  checkpoint_path(const std::filesystem::path &output_folder,
                  unsigned long                step);

  /// Where that checkpoint is written.
  std::filesystem::path
  part_of(const std::filesystem::path &checkpoint);

  /// All checkpoints, the newest first, without what was left half-written.
  std::vector<std::filesystem::path>
  find_checkpoints(const std::filesystem::path &output_folder);

  /// Remove what a killed run left half-written.
  void
  remove_parts(const std::filesystem::path &output_folder);

  /// Make the empty folder part_of(@p checkpoint).
  std::string
  make_part(const std::filesystem::path &checkpoint);

  /// Bring all files in a folder, and their names, to the disk.
  std::string
  sync_folder(const std::filesystem::path &folder);

  /// Give the complete checkpoint its name.
  std::string
  publish(const std::filesystem::path &checkpoint);

  /// Remove all checkpoints but these.
  void
  remove_checkpoints_but(const std::filesystem::path &output_folder,
                         const std::vector<std::filesystem::path> &kept);
} // namespace talus

#endif

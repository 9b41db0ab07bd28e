#ifndef talus_checkpoint_checkpoint_search_h
#define talus_checkpoint_checkpoint_search_h

#include <talus/checkpoint/checkpoint_content.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  constexpr const char *state_file_name = "state.h5";
  constexpr const char *mesh_file_name  = "mesh";

  /// Names and checksums of the mesh files in a checkpoint, one per line; to be
  /// called on one rank.
  std::string
  mesh_checksums(const std::filesystem::path &checkpoint);



  /// A checkpoint that can be loaded.
  struct FoundCheckpoint
  {
    std::filesystem::path path;
    CheckpointHead        head;
    /// One sentence for each newer one that is damaged.
    std::vector<std::string> complaints;
  };



  /// The newest checkpoint in the output folder whose content agrees with its
  /// checksums. Throws ExcUser if there is none, or if it is of another format
  /// or dimension. Collective.
  FoundCheckpoint
  find_checkpoint(const std::filesystem::path &output_folder,
                  unsigned int                 dimension,
                  MPI_Comm                     communicator);



  /// Throw ExcUser if the output folder holds the checkpoint of a run that did
  /// not reach its end: days of computing are not to be overwritten by a
  /// forgotten --resume. Collective.
  void
  check_nothing_unfinished(const std::filesystem::path &output_folder,
                           MPI_Comm                     communicator);
} // namespace talus

#endif

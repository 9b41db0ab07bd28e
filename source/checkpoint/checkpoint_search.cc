#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_folder.h>
#include <talus/checkpoint/checkpoint_search.h>
#include <talus/io/checksum.h>

#include <algorithm>
#include <fstream>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
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



    std::uint64_t
    checksum_of_file(const fs::path &path)
    {
      std::ifstream      file(path, std::ios::binary);
      std::vector<char>  block(1 << 20);
      boost::crc_32_type crc;
      do
        {
          file.read(block.data(), block.size());
          crc.process_bytes(block.data(), file.gcount());
      } while (file);
      return crc.checksum();
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



    /// What is wrong with the content of the checkpoint; empty if nothing is.
    std::string
    find_damage(Hdf5File &file, const fs::path &checkpoint)
    {
      for (const std::string group : {"cells", "points", "state", "text"})
        for (const std::string &name : file.names(group))
          file.verify(group + "/" + name);
      file.verify("parameters");
      file.verify("mesh");
      const std::string saved = file.read_text("mesh");
      if (!file.error().empty())
        return file.error();
      const MPI_Comm communicator = file.communicator();
      std::string    complaint;
      if (is_first_rank(communicator) && mesh_checksums(checkpoint) != saved)
        complaint =
          "the checksums of its mesh files do not match their content";
      return first_sentence(complaint, communicator);
    }
  } // namespace



  std::string
  mesh_checksums(const fs::path &checkpoint)
  {
    std::vector<fs::path> paths;
    for (const auto &entry : fs::directory_iterator(checkpoint))
      if (entry.path().filename() != state_file_name)
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::string result;
    for (const fs::path &path : paths)
      result +=
        text(path.filename().string(), ' ', checksum_of_file(path), '\n');
    return result;
  }



  FoundCheckpoint
  find_checkpoint(const fs::path    &output_folder,
                  const unsigned int dimension,
                  const MPI_Comm     communicator)
  {
    FoundCheckpoint found;
    for (const fs::path &path : list_for_all_ranks(output_folder, communicator))
      {
        Hdf5File file(path / state_file_name,
                      Hdf5File::Access::read,
                      communicator);
        found.head = load_head(file);
        if (file.error().empty())
          check_kind(path, found.head, dimension);
        const std::string damage = find_damage(file, path);
        if (damage.empty())
          {
            found.path = path;
            return found;
          }
        found.complaints.push_back("The checkpoint '" + path.string() +
                                   "' is damaged: " + damage + ".");
      }
    std::string all;
    for (const std::string &complaint : found.complaints)
      all += complaint + ' ';
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



  void
  check_nothing_unfinished(const fs::path &output_folder,
                           const MPI_Comm  communicator)
  {
    const auto all = list_for_all_ranks(output_folder, communicator);
    if (all.empty())
      return;
    Hdf5File             file(all[0] / state_file_name,
                  Hdf5File::Access::read,
                  communicator);
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

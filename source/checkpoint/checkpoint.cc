// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint.h>
#include <talus/transfer/points_of_cells.h>
#include <talus/version.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /// Convert to minutes, the unit of the parameters.
    double
    minutes(const std::chrono::steady_clock::duration duration)
    {
      return std::chrono::duration<double>(duration).count() / 60.;
    }



    /// Return the reason why the folder has no room for @p n_bytes, or an empty
    /// text. p4est ends the program if the disk is full. Only a reservation
    /// knows of quotas; some file systems cannot reserve.
    std::string
    lack_of_space(const fs::path &folder, const double n_bytes)
    {
      const fs::path path = folder / state_file_name;
      const int      file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0666);
      const int error     = (::fallocate(file, 0, 0, n_bytes) == 0 ? 0 : errno);
      ::close(file);
      std::error_code ignored;
      fs::remove(path, ignored);
      const auto space = fs::space(folder, ignored);
      if (error == ENOSPC || error == EDQUOT)
        return std::strerror(error);
      return space.available < n_bytes ? std::strerror(ENOSPC) : "";
    }
  } // namespace



  template <int dim>
  Checkpoint<dim>::Checkpoint()
    : ParameterAcceptor("/Checkpoint")
  {
    add_parameter("Step interval",
                  step_interval_,
                  "Number of steps between two checkpoints [-]; 0: no "
                  "checkpoints by steps.",
                  this->prm,
                  Patterns::Integer(0));
    add_parameter("Wall time interval",
                  wall_interval_,
                  "Wall time between two checkpoints [min]; 0: no checkpoints "
                  "by wall time.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Wall time limit",
                  wall_time_limit_,
                  "Wall time after which the run writes a checkpoint and ends "
                  "with exit status 75 [min]; `talus --resume` continues the "
                  "run. 0: no limit.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("At the end",
                  at_the_end_,
                  "Write a checkpoint also at the end time, so that the run "
                  "can be continued to a later end time.");
  }



  /// The checkpoint used is the newest valid one. Newer ones are damaged,
  /// otherwise they would have been used; they stay until replaced. Only the
  /// first rank changes the folder.
  template <int dim>
  void
  Checkpoint<dim>::begin(const fs::path &output_folder,
                         const MPI_Comm  communicator,
                         const fs::path &resumed_from)
  {
    output_folder_ = output_folder;
    communicator_  = communicator;
    last_          = resumed_from;
    start_ = last_time_ = Clock::now();
    if (!is_first_rank(communicator_))
      return;
    remove_unfinished(output_folder_);
    if (resumed_from.empty())
      {
        remove_checkpoints_but(output_folder_, {});
        return;
      }
    // The run may have been killed before it removed the third newest.
    std::vector<fs::path> kept = find_checkpoints(output_folder_);
    // Newest first: the previous checkpoint follows the checkpoint used.
    const auto used = std::find(kept.begin(), kept.end(), resumed_from);
    if (kept.end() - used > 2)
      {
        kept.erase(used + 2, kept.end());
        remove_checkpoints_but(output_folder_, kept);
      }
  }



  /// All ranks agree on steps. On the wall time the first rank decides alone,
  /// since clocks differ and a rank that began to write would wait for the
  /// others. See StepAgreement.
  template <int dim>
  bool
  Checkpoint<dim>::is_due(const unsigned long step) const
  {
    if (step_interval_ > 0 && step % step_interval_ == 0)
      return true;
    return wall_interval_ > 0 && is_first_rank(communicator_) &&
           minutes(Clock::now() - last_time_) >= wall_interval_;
  }



  template <int dim>
  bool
  Checkpoint<dim>::limit_is_reached() const
  {
    return wall_time_limit_ > 0 && is_first_rank(communicator_) &&
           minutes(Clock::now() - start_) >= wall_time_limit_;
  }



  /// A crash at any time leaves earlier checkpoints intact. Therefore the order
  /// is fixed: write everything under a temporary name; flush every file to
  /// disk; rename; and only then remove the third newest. Each part ends with
  /// an exchange of errors among the ranks. Points and grid are only read, so
  /// the run continues with bit-identical results. Collective.
  template <int dim>
  fs::path
  Checkpoint<dim>::write(const Content &content)
  {
    const fs::path path     = checkpoint_path(output_folder_, content.step);
    const fs::path part     = temporary_path(path);
    const bool     is_first = is_first_rank(communicator_);

    check_on_all_ranks(is_first ? make_temporary_folder(path) : "");
    write_mesh(part, content);
    write_state(part, content);
    write_file(part / checksums_file_name, list_checksums(part, communicator_));
    // Each node of a cluster flushes its own part to disk.
    check_on_all_ranks(sync_folder(part));
    check_on_all_ranks(is_first ? commit(path) : "");
    // A checkpoint rewritten at the same step keeps the previous one.
    if (is_first && path != last_)
      remove_checkpoints_but(output_folder_, {path, last_});
    last_      = path;
    last_time_ = Clock::now();
    return path;
  }



  template <int dim>
  void
  Checkpoint<dim>::check_on_all_ranks(const std::string &error) const
  {
    const std::string sentence = first_sentence(error, communicator_);
    if (sentence.empty())
      return;
    // The incomplete files only use space.
    if (is_first_rank(communicator_))
      remove_unfinished(output_folder_);
    AssertThrow(false,
                ExcUser("A checkpoint could not be written to '" +
                        output_folder_.string() + "' (" + sentence + "). " +
                        (last_.empty()
                           ? "There is no earlier checkpoint: free some space "
                             "and start again"
                           : "Earlier checkpoints remain: free some space and "
                             "continue with --resume") +
                        ", or choose another folder with --output."));
  }



  /// Save the mesh with the points, if there is space for an upper estimate of
  /// the few files of the mesh. Other programs may fill the disk meanwhile, but
  /// rarely; deal.II then may not notice, so the size is compared. Collective.
  template <int dim>
  void
  Checkpoint<dim>::write_mesh(const fs::path &folder,
                              const Content  &content) const
  {
    const auto  &points = content.points;
    const double n_bytes =
      sizeof(double) *
      Utilities::MPI::sum(content.cell_weights.size() +
                            1. * points.n_arrays() * points.size(),
                          communicator_);
    const double n_bytes_of_mesh = 1e5 + 64. * content.grid.n_global_cells();
    check_on_all_ranks(is_first_rank(communicator_)
                         ? lack_of_space(folder, n_bytes + n_bytes_of_mesh)
                         : "");
    attach_points(content.grid, points, content.cell_weights);
    content.grid.save((folder / mesh_file_name).string());
    std::error_code error;
    const auto      size = fs::file_size(folder / points_file_name, error);
    check_on_all_ranks(
      error || size < n_bytes ? "the file of the points is not complete" : "");
  }



  /// Collective.
  template <int dim>
  void
  Checkpoint<dim>::write_state(const fs::path &folder,
                               const Content  &content) const
  {
    Hdf5Image file;
    save_head(file,
              {dim,
               Utilities::MPI::n_mpi_processes(communicator_),
               content.step,
               content.time,
               content.end_time,
               TALUS_VERSION,
               TALUS_GIT_REVISION});
    file.write_text("parameters", content.parameters);
    save_columns(file, content.points);
    save_state(file, content.state, communicator_);
    write_file(folder / state_file_name, file.bytes());
  }



  /// Write the bytes of the first rank. Collective.
  template <int dim>
  void
  Checkpoint<dim>::write_file(const fs::path    &path,
                              const std::string &bytes) const
  {
    std::string error;
    if (is_first_rank(communicator_))
      {
        errno = 0;
        std::ofstream file(path, std::ios::binary);
        file << bytes;
        file.close();
        if (!file)
          error = std::strerror(errno);
      }
    check_on_all_ranks(error);
  }



  template class Checkpoint<2>;
  template class Checkpoint<3>;
} // namespace talus

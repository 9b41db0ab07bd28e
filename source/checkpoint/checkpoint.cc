// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint.h>
#include <talus/version.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  namespace
  {
    /// The unit of the parameters.
    double
    minutes(const std::chrono::steady_clock::duration duration)
    {
      return std::chrono::duration<double>(duration).count() / 60.;
    }
  } // namespace



  template <int dim>
  Checkpoint<dim>::Checkpoint()
    : ParameterAcceptor("/Checkpoint")
  {
    add_parameter("Step interval",
                  step_interval_,
                  "Number of steps between two checkpoints [-]; 0 for none by "
                  "steps.",
                  this->prm,
                  Patterns::Integer(0));
    add_parameter("Wall time interval",
                  wall_interval_,
                  "Time on the clock between two checkpoints [min]; 0 for none "
                  "by the clock.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Wall time limit",
                  wall_time_limit_,
                  "After this time on the clock [min] the run writes a "
                  "checkpoint and ends with exit status 75; `talus --resume` "
                  "goes on. 0 for no limit.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("At the end",
                  at_the_end_,
                  "Write a checkpoint at the end time, too, so that the run "
                  "can be continued to a later one.");
  }



  template <int dim>
  void
  Checkpoint<dim>::check_nothing_is_lost(
    const std::filesystem::path &output_folder,
    const MPI_Comm               communicator) const
  {
    if (!may_overwrite_)
      check_nothing_unfinished(output_folder, communicator);
  }



  /// The newest checkpoint is the one the run came from. Those that are newer
  /// by name are damaged, or it would have been taken; they stay until a good
  /// one takes their place. Only the first rank touches the folder.
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
    // The newest first: behind the one used comes the one before it.
    const auto used = std::find(kept.begin(), kept.end(), resumed_from);
    if (kept.end() - used > 2)
      {
        kept.erase(used + 2, kept.end());
        remove_checkpoints_but(output_folder_, kept);
      }
  }



  /// By steps all ranks agree; by the clock the first one says so alone, since
  /// clocks differ and a rank that began to write by itself would wait for the
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



  /// A crash at any time leaves the checkpoints before this one whole. For that
  /// the order is fixed: write all under a temporary name; bring every file to
  /// the disk; rename; and only then remove the third newest. Errors of one
  /// rank are told to all after each part. Points and grid are only read, so
  /// that a run goes on bitwise as it would have without. Collective.
  template <int dim>
  fs::path
  Checkpoint<dim>::write(const Content &content, const Grid<dim> &grid)
  {
    const fs::path path     = checkpoint_path(output_folder_, content.step);
    const fs::path part     = temporary_path(path);
    const bool     is_first = is_first_rank(communicator_);

    check_on_all_ranks(is_first ? make_temporary_folder(path) : "");
    write_mesh(part, grid);
    write_state(part, content);
    // Every node of a cluster brings its own part to the disk.
    check_on_all_ranks(sync_folder(part));
    check_on_all_ranks(is_first ? commit(path) : "");
    // Written anew at the same step, it leaves the one before it alone.
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
    // What was written so far only takes space.
    if (is_first_rank(communicator_))
      remove_unfinished(output_folder_);
    AssertThrow(false,
                ExcUser("A checkpoint could not be written to '" +
                        output_folder_.string() + "' (" + sentence +
                        "). Earlier ones are still there: free some space and "
                        "go on with --resume, or choose another folder with "
                        "--output."));
  }



  /// An estimate from above for the few files of p4est and deal.II; the space
  /// may be taken by others meanwhile, but that is the exception. Collective.
  template <int dim>
  void
  Checkpoint<dim>::write_mesh(const fs::path  &folder,
                              const Grid<dim> &grid) const
  {
    // p4est ends the program where the disk is full.
    const double    needed = 1e5 + 64. * grid.n_global_cells();
    std::error_code error;
    const auto      space = fs::space(folder, error);
    check_on_all_ranks(!error && space.available < needed
                         ? "No space left on device for the mesh"
                         : "");
    grid.save((folder / mesh_file_name).string());
  }



  /// One HDF5 file for all ranks. The mesh is written before, since its
  /// checksums are in this file: so one file says whether the whole checkpoint
  /// is sound. Collective.
  template <int dim>
  void
  Checkpoint<dim>::write_state(const fs::path &folder,
                               const Content  &content) const
  {
    CheckpointHead head;
    head.dimension = dim;
    head.n_ranks   = Utilities::MPI::n_mpi_processes(communicator_);
    head.step      = content.step;
    head.time      = content.time;
    head.end_time  = content.end_time;
    head.version   = TALUS_VERSION;
    head.revision  = TALUS_GIT_REVISION;

    Hdf5OutputFile file(folder / state_file_name, communicator_);
    save_head(file, head);
    save_points(file, content.points, content.cell_weights);
    save_state(file, content.state);
    file.write_text("parameters", content.parameters);
    // The mesh is complete: all ranks have left save().
    file.write_text("mesh",
                    is_first_rank(communicator_) ? mesh_checksums(folder) : "");
    file.close();
    check_on_all_ranks(file.error());
  }



  template class Checkpoint<2>;
  template class Checkpoint<3>;
} // namespace talus

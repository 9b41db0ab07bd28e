// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_content_h
#define talus_checkpoint_checkpoint_content_h

#include <talus/base/state_list.h>
#include <talus/io/hdf5_image.h>
#include <talus/points/points.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>

namespace talus
{
  // Content of a checkpoint: the mesh with the points of the cells in files of
  // deal.II and p4est, everything else in the file `state.h5`, and a list of
  // checksums; see doc/output.md.

  constexpr const char *state_file_name     = "state.h5";
  constexpr const char *mesh_file_name      = "mesh";
  constexpr const char *points_file_name    = "mesh_variable.data";
  constexpr const char *checksums_file_name = "checksums";

  /// Version of the file format. Increase when old and new versions of talus
  /// cannot read each other's files.
  constexpr unsigned int checkpoint_format = 12;

  /// Summary of a checkpoint.
  struct CheckpointHead
  {
    unsigned int  dimension = 0;
    unsigned int  n_ranks   = 0;
    unsigned long step      = 0;
    double        time      = 0; ///< s
    double        end_time  = 0; ///< planned end of the run, s
    std::string   version;       ///< version of talus
    std::string   revision;      ///< git revision
  };

  void
  save_head(Hdf5Image &file, const CheckpointHead &head);

  CheckpointHead
  load_head(const Hdf5Image &file);



  /// Save the names and units of the columns of the points.
  template <int dim>
  void
  save_columns(Hdf5Image &file, const Points<dim> &points);

  /// Throw ExcUser if the saved columns differ from the columns of @p points.
  template <int dim>
  void
  check_columns(const Hdf5Image &file, const Points<dim> &points);



  /// Save numbers of every rank, texts and tables. Afterwards @p file is
  /// complete on the first rank. Collective.
  void
  save_state(Hdf5Image &file, const StateList &list, MPI_Comm communicator);

  /// Load the values saved by save_state(). Throws ExcUser if a value is
  /// missing.
  void
  load_state(const Hdf5Image &file,
             const StateList &list,
             MPI_Comm         communicator);

  /// Open the state file of a checkpoint. Collective.
  Hdf5Image
  open_state(const std::filesystem::path &checkpoint, MPI_Comm communicator);



  /// Whether @p name is a file of a checkpoint.
  bool
  is_checkpoint_file(const std::string &name);

  /// Content of the file `checksums` for a checkpoint: the format and a
  /// checksum of each other file. Collective.
  std::string
  list_checksums(const std::filesystem::path &checkpoint,
                 MPI_Comm                     communicator);

  /// Return a description of the damage of a checkpoint: a missing or changed
  /// file; empty if there is no damage. Throws ExcUser if the checkpoint has
  /// another format. Collective.
  std::string
  find_damage(const std::filesystem::path &checkpoint, MPI_Comm communicator);
} // namespace talus

#endif

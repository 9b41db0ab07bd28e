// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_content_h
#define talus_checkpoint_checkpoint_content_h

#include <talus/base/state.h>
#include <talus/io/hdf5_input_file.h>
#include <talus/io/hdf5_output_file.h>
#include <talus/points/points.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  // What is in a checkpoint: the mesh in files of p4est, all else in the file
  // `state.h5`; see doc/output.md.

  constexpr const char *state_file_name = "state.h5";
  constexpr const char *mesh_file_name  = "mesh";

  /// To be raised when a talus of today could not read the file of tomorrow, or
  /// the other way round.
  constexpr std::uint64_t checkpoint_format = 6;

  /// What one wants to know of a checkpoint first: attributes of the file.
  struct CheckpointHead
  {
    std::uint64_t format    = checkpoint_format;
    std::uint64_t dimension = 0;
    std::uint64_t n_ranks   = 0;
    std::uint64_t step      = 0;
    double        time      = 0; ///< s
    double        end_time  = 0; ///< of the run as it was planned, s
    std::string   version;       ///< of talus
    std::string   revision;      ///< git's
  };

  void
  save_head(Hdf5OutputFile &file, const CheckpointHead &head);

  /// Where the file has another format only that is right.
  CheckpointHead
  load_head(Hdf5InputFile &file);



  /// Save the points, sorted, and for each cell that this rank owns the number
  /// of its points and its weight at the last repartition. All are in the order
  /// of the cells, those of the first rank first.
  template <int dim>
  void
  save_points(Hdf5OutputFile            &file,
              const Points<dim>         &points,
              const std::vector<double> &cell_weights);

  /// Load the weights of the @p n_cells cells this rank owns now.
  std::vector<double>
  load_cell_weights(Hdf5InputFile &file, unsigned int n_cells);

  /// Load the points of the @p n_cells cells this rank owns now, in the order
  /// they had, which is part of the state. Returns the cell of each; @p points
  /// must be empty and have its columns. Throws ExcUser if the file has others.
  template <int dim>
  std::vector<unsigned int>
  load_points(Hdf5InputFile &file, unsigned int n_cells, Points<dim> &points);



  /// Save every rank's share of the numbers, and the texts.
  void
  save_state(Hdf5OutputFile &file, const StateList &list);

  /// Set what save_state() saved. Throws ExcUser if something is missing.
  void
  load_state(Hdf5InputFile &file, const StateList &list);



  /// Whether deal.II gives a file of the mesh this name.
  bool
  is_mesh_file(const std::string &name);

  /// Names and checksums of the mesh files in a checkpoint, one per line; to be
  /// called on one rank.
  std::string
  mesh_checksums(const std::filesystem::path &checkpoint);

  /// Throw ExcUser if the file could not be read.
  void
  check_read(const Hdf5InputFile &file);
} // namespace talus

#endif

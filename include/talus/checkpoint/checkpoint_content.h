// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_checkpoint_content_h
#define talus_checkpoint_checkpoint_content_h

#include <talus/base/state_list.h>
#include <talus/io/hdf5_input_file.h>
#include <talus/io/hdf5_output_file.h>
#include <talus/points/points.h>

#include <filesystem>
#include <string>
#include <vector>

namespace talus
{
  // Content of a checkpoint: the mesh in files of p4est, everything else in the
  // file `state.h5`; see doc/output.md.

  constexpr const char *state_file_name = "state.h5";
  constexpr const char *mesh_file_name  = "mesh";

  /// Version of the file format. Increase when old and new versions of talus
  /// cannot read each other's files.
  constexpr std::uint64_t checkpoint_format = 11;

  /// Summary of a checkpoint: attributes of the file.
  struct CheckpointHead
  {
    std::uint64_t format    = checkpoint_format;
    std::uint64_t dimension = 0;
    std::uint64_t n_ranks   = 0;
    std::uint64_t step      = 0;
    double        time      = 0; ///< s
    double        end_time  = 0; ///< planned end of the run, s
    std::string   version;       ///< version of talus
    std::string   revision;      ///< git revision
  };

  void
  save_head(Hdf5OutputFile &file, const CheckpointHead &head);

  /// Load the summary. If the format differs, all other fields are undefined.
  CheckpointHead
  load_head(Hdf5InputFile &file);



  /// Save the sorted points and, for each owned cell, number of points and
  /// weight. Rows are in the order of the cells, ranks in ascending order.
  /// Collective.
  ///
  /// @param cell_weights weights of the owned cells at the last repartition
  template <int dim>
  void
  save_points(Hdf5OutputFile            &file,
              const Points<dim>         &points,
              const std::vector<double> &cell_weights);

  /// Load the weights of the @p n_cells cells owned by this rank.
  std::vector<double>
  load_cell_weights(Hdf5InputFile &file, unsigned int n_cells);

  /// Load the points of the cells owned by this rank in their saved order,
  /// which is part of the state. Throws ExcUser if the columns in the file
  /// differ. Collective.
  ///
  /// @param n_cells number of owned cells
  /// @param points must be empty and have all columns
  /// @return cell of each point
  template <int dim>
  std::vector<unsigned int>
  load_points(Hdf5InputFile &file, unsigned int n_cells, Points<dim> &points);



  /// Save numbers of every rank, texts and tables. Collective.
  void
  save_state(Hdf5OutputFile &file, const StateList &list);

  /// Load the values saved by save_state(). Throws ExcUser if a value is
  /// missing. Collective.
  void
  load_state(Hdf5InputFile &file, const StateList &list);



  /// Whether deal.II uses @p name for a file of the mesh.
  bool
  is_mesh_file(const std::string &name);

  /// Names and checksums of the mesh files in a checkpoint, one per line. Call
  /// on one rank only.
  std::string
  mesh_checksums(const std::filesystem::path &checkpoint);

  /// Throw ExcUser if reading the file failed.
  void
  check_read(const Hdf5InputFile &file);
} // namespace talus

#endif

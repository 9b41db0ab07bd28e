#ifndef talus_io_hdf5_output_h
#define talus_io_hdf5_output_h

#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

namespace talus
{
  /// Write the cells of all ranks with their fields to one HDF5 file (see
  /// Hdf5Writer); collective. Throws ExcUser if that fails.
  ///
  /// Group "mesh" has the datasets "vertices", x, y, z [m], and "cells", the
  /// rows of "vertices" that make up each cell, in VTK's order; its attribute
  /// "type" is that of XDMF. Group "fields" has a dataset per field, named as
  /// the field without its unit; attributes are "name" (the whole), "unit" and
  /// "at", which says whether a row is a vertex or a cell.
  template <int cell_dim, int dim>
  void
  write_hdf5(const std::filesystem::path      &path,
             MPI_Comm                          communicator,
             const OutputCells<cell_dim, dim> &cells,
             double                            time,
             unsigned long                     step);
} // namespace talus

#endif

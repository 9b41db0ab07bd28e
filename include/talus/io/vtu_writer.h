#ifndef talus_io_vtu_h
#define talus_io_vtu_h

#include <talus/io/output_cells.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace talus
{
  /// Write the cells of this rank as a whole VTU file: single precision,
  /// compressed, without date. The fields become cell or point data, whichever
  /// their items are at. (deal.II's writer knows point data only, so that each
  /// box would hold its values at every corner.)
  template <int cell_dim, int dim>
  void
  write_vtu(std::ostream                     &out,
            const OutputCells<cell_dim, dim> &cells,
            double                            time,
            unsigned long                     step);



  /// Write the cells into the folder: one file base.vtu or, with several ranks,
  /// one base.R.vtu per rank R that has cells and base.pvtu. Collective. Appends
  /// the files that this rank wrote to @p written and returns the name of the
  /// one that ParaView is to open. Throws ExcUser if that fails.
  template <int cell_dim, int dim>
  std::string
  write_vtu(const std::filesystem::path        &folder,
            const std::string                  &base,
            MPI_Comm                            communicator,
            const OutputCells<cell_dim, dim>   &cells,
            double                              time,
            unsigned long                       step,
            std::vector<std::filesystem::path> &written);
} // namespace talus

#endif

#ifndef talus_io_series_h
#define talus_io_series_h

#include <talus/io/files.h>
#include <talus/io/output_cells.h>
#include <talus/io/xdmf.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// How fields are written.
  enum class FieldFormat
  {
    vtu, ///< one file per rank and time, opened in ParaView by name.pvd
    hdf5 ///< one file per time, opened in ParaView by name.xdmf
  };



  /// A sequence of files over time, name-0000.*, name-0001.*, ..., and an index
  /// that gives ParaView their times. As VTU: name-NNNN.vtu, or with several
  /// ranks one name-NNNN.R.vtu per rank R and a name-NNNN.pvtu, and name.pvd.
  /// As HDF5: name-NNNN.h5, whatever the number of ranks, and name.xdmf.
  class FieldSeries
  {
  public:
    /// Start anew, or go on after the files that were there at the checkpoint.
    void
    begin(const std::filesystem::path &folder,
          const std::string           &name,
          MPI_Comm                     communicator,
          FieldFormat                  format,
          Beginning                    beginning = Beginning::anew);

    /// Add the times and names of the files to the state of the run, as the
    /// text @p name: per file a line with the time [s], a space and the name.
    void
    list_state(const std::string &name, StateList &list);

    /// Write the files of the next output time; collective. Throws ExcUser if
    /// that fails.
    template <int cell_dim, int dim>
    void
    write(const OutputCells<cell_dim, dim> &cells,
          double                            time,
          unsigned long                     step);

    /// Bring all files that this rank wrote to the disk. Throws ExcUser if that
    /// fails.
    void
    sync();

  private:
    std::filesystem::path
    write_index();

    std::filesystem::path                       folder_;
    std::string                                 name_;
    MPI_Comm                                    communicator_ = MPI_COMM_NULL;
    FieldFormat                                 format_ = FieldFormat::vtu;
    std::vector<std::pair<double, std::string>> times_and_names_;
    XdmfIndex                                   xdmf_;
    std::vector<std::filesystem::path>          unsynced_;
  };
} // namespace talus

#endif

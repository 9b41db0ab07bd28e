#ifndef talus_observers_grid_output_h
#define talus_observers_grid_output_h

#include <talus/io/series.h>
#include <talus/observers/snapshot.h>

namespace talus
{
  /// The series of files called grid, in one of the formats of FieldWriter: the cells of
  /// the background grid that hold points, with the mass, velocity and force of
  /// the step before at their nodes. All three are zero at nodes the step did
  /// not touch, and at the start; mass and force of a hanging node went to its
  /// masters.
  template <int dim>
  class GridOutput
  {
  public:
    void
    begin(const std::filesystem::path &folder,
          MPI_Comm                     communicator,
          const std::string           &format    = "vtu",
          Beginning                    beginning = Beginning::anew);

    void
    list_state(StateList &list);

    /// Write the files of one output time; collective. Throws ExcUser if that
    /// fails.
    void
    write(const Snapshot<dim> &snapshot);

    /// Bring all files written so far to the disk.
    void
    sync();

  private:
    FieldSeries series_;
  };
} // namespace talus

#endif

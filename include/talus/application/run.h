// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_run_h
#define talus_application_run_h

#include <talus/base/quantity.h>

#include <mpi.h>

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  class ParameterFile;

  /// Velocity of an obstacle, dim components, m/s, from the time in the middle
  /// of a step, s. Called once per step on every rank; all ranks must get the
  /// same velocity.
  using ObstacleVelocity = std::function<std::vector<double>(double time)>;

  /// Options of a run besides its parameters.
  struct RunOptions
  {
    std::string output_folder;     ///< in place of Output/Folder, unless empty
    bool        resume    = false; ///< from the newest checkpoint
    bool        overwrite = false; ///< checkpoints of an unfinished run, too
    /// Velocities of moving obstacles by name, in place of their parameters.
    std::map<std::string, ObstacleVelocity> obstacle_velocities;
  };

  /// View of a column of the points of this rank.
  struct PointColumn
  {
    std::string name;
    std::string unit; ///< "-" if dimensionless
    /// Shape of the value of a point: {} for a number, {n} for a vector or a
    /// list, {dim, dim} for a tensor.
    std::vector<unsigned int> shape;
    unsigned int              n_points;
    const double             *data;  ///< first component of the first point
    std::size_t               pitch; ///< doubles between two components
    /// Keeps the memory. The values are those of the run until its next step,
    /// and undefined numbers afterwards.
    std::shared_ptr<const double> owner;
  };

  /// Motion of an obstacle, and force of the soil on the obstacle over all
  /// ranks; in 2-D per metre width.
  struct ObstacleState
  {
    std::string         name;
    std::vector<double> displacement; ///< since the start, dim components, m
    std::vector<double> velocity;     ///< in the last step, m/s
    std::vector<double> force;        ///< mean of the last step, dim, N
    std::vector<double> moment;       ///< 1 (2-D) or 3 components, N m, about
                                      ///< the reference point
    std::vector<double> impulse;      ///< since the start, dim, N s
    double              contact_area = 0; ///< m^(dim-1)
  };



  /// A run of talus, in 2-D or 3-D, led by a program: the program `talus`, the
  /// Python module or a program of the user.
  ///
  /// Several runs may exist in a process, with different communicators, as
  /// long as one thread at a time calls their functions. All parameters are
  /// read by the constructor. MPI must be initialized before and finalized
  /// after the life of a run. Functions marked as collective are called by all
  /// ranks of the communicator. After an exception of advance_to() or
  /// advance_to_end() only the destructor may be called, unless the exception
  /// came from an observer.
  class Run
  {
  public:
    /// Read all parameters, and make mesh and points, or load the newest
    /// checkpoint. Writes nothing. Throws ExcUser if parameters or options are
    /// invalid. Collective.
    Run(const ParameterFile &file,
        const RunOptions    &options,
        MPI_Comm             communicator);
    ~Run();

    Run(Run &&other) noexcept;

    /// Call @p observer after each step of advance_to(). The observer may call
    /// stop() and write_checkpoint(), and read the state; an exception leaves
    /// the run between two steps, and advance_to() may be called again.
    void
    set_observer(const std::function<void()> &observer);

    /// Advance to the first step that reaches @p time, s, or to the end of the
    /// run. The time steps do not depend on @p time, so the results are
    /// bit-identical to those of an uninterrupted run. The first call begins
    /// the files and runs the static stages. Return false if stop() or the
    /// limit of wall time stopped the run earlier. Collective.
    bool
    advance_to(double time);

    /// Advance to the end of the run, with signals handled as by the program
    /// `talus`. Return false if a signal or the limit of wall time stopped the
    /// run earlier; a checkpoint has then been written. Collective.
    bool
    advance_to_end();

    /// Let advance_to() return after the present step, with a checkpoint. It
    /// suffices that one rank calls.
    void
    stop();

    /// Write a checkpoint and return its path. Call after advance_to(), or in
    /// an observer. Collective.
    std::string
    write_checkpoint();

    /// Throw ExcUser if advance_to() would refuse the output folder.
    /// Collective.
    void
    check_output_folder() const;

    /// Log a description of the run, with an estimate of the wall time. Only
    /// the destructor may be called afterwards. Collective.
    void
    forecast();

    /// Number of remarks so far as text, see Simulation::count_of_remarks().
    std::string
    count_of_remarks() const;

    unsigned int
    dimension() const;

    MPI_Comm
    communicator() const;

    const std::string &
    output_folder() const;

    /// Time of the state, s.
    double
    time() const;

    /// Time at which the run ends, s, unless the soil is at rest before.
    double
    end_time() const;

    /// Length of the last step, s; 0 before the first step.
    double
    time_step() const;

    /// Number of steps so far.
    unsigned long
    n_steps() const;

    bool
    is_finished() const;

    /// Columns of the points of this rank.
    std::vector<PointColumn>
    point_columns() const;

    /// Row that statistics.csv would have now; complete on the first rank.
    /// Collective.
    Quantities
    statistics() const;

    /// Energies, J, and components of the impulses on the soil, N s, that the
    /// parts of the program have recorded since the start, over all ranks.
    /// Collective.
    Quantities
    accounts() const;

    /// All obstacles, in the order of the parameter Obstacles/Names.
    std::vector<ObstacleState>
    obstacles() const;

  private:
    struct Parts;

    bool
    advance(double time);
    bool
    is_stop_requested();
    void
    check_usable() const;
    template <typename Action>
    bool
    lead(const Action &action);

    std::unique_ptr<Parts> parts_;
  };
} // namespace talus

#endif

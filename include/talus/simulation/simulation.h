// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_simulation_h
#define talus_simulation_simulation_h

#include <talus/checkpoint/checkpoint.h>
#include <talus/io/log.h>
#include <talus/observers/output.h>
#include <talus/problem/problem.h>
#include <talus/simulation/background_mesh.h>
#include <talus/simulation/explicit_scheme.h>
#include <talus/simulation/rest_detector.h>
#include <talus/simulation/static_stages.h>
#include <talus/state/state.h>
#include <talus/transfer/transfer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Simulation of a submarine landslide, or of another motion of soft bodies
  /// on a mesh: sets up or resumes a run, leads the run through its stages to
  /// the end time, and directs output and checkpoints. The parts do the work.
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    /// Declare all parameters. They must be parsed before another simulation is
    /// constructed, and are read no more after set_up() or resume(): deal.II's
    /// parameters are global, see ParameterFile.
    Simulation(const ParameterPreview &preview, MPI_Comm communicator);

    /// Let a function of the caller prescribe the velocity of an obstacle, see
    /// Obstacle::prescribe_velocity(). Call after parsing. Throws ExcUser
    /// without an obstacle of this name.
    void
    prescribe_velocity(const std::string                            &obstacle,
                       const typename Obstacle<dim>::VelocityOfTime &velocity)
    {
      problem_.obstacles.prescribe_velocity(obstacle, velocity);
    }

    /// Make mesh and points from the parsed parameters. Throws ExcUser if
    /// parameters contradict each other. Writes nothing. Collective.
    void
    set_up();

    /// Load the newest checkpoint in the output folder; replaces set_up().
    /// Throws ExcUser if no checkpoint fits. Writes nothing. Collective.
    void
    resume();

    /// Add a remark on the parameters. Call before set_up() or resume().
    void
    add_remark(const std::string &remark)
    {
      problem_.add_remarks(std::vector<Remark>{remark});
    }

    /// Let run() overwrite the checkpoints of an unfinished run.
    void
    allow_overwriting()
    {
      checkpoint_.allow_overwriting();
    }

    /// Throw ExcUser if run() would refuse the present output folder, except
    /// because of another active run in the folder. Writes nothing. Collective.
    void
    check_output_folder() const;

    /// Log what run() will do, with all remarks: mesh, points, cells across the
    /// thinnest body, time step, and an estimate of the wall time from some
    /// steps. Afterwards the state is no longer the initial state. Writes no
    /// files. Collective.
    void
    forecast();

    /// Return the number of remarks as text, for example "1 remark"; empty
    /// without remarks. Call on the first rank only.
    std::string
    count_of_remarks() const
    {
      return log_.count_of_remarks();
    }

    /// Compute from the start, or the checkpoint, to the end of the run, with
    /// output: begin(), step() until is_finished(), end(). Return false if a
    /// signal or the limit of wall time stopped the run earlier; resume() can
    /// then continue. Collective.
    bool
    run();

    /// Begin the files and run the static stages. Return false if the run was
    /// stopped between two stages. Collective.
    bool
    begin();

    /// Advance by one step, with the output and the checkpoint that are due.
    /// Return false if a signal or the limit of wall time stops the run here;
    /// a checkpoint has then been written. Call after begin(), unless
    /// is_finished(). Collective.
    bool
    step();

    /// Write a checkpoint and log that the caller stops the run. Call between
    /// two steps. Collective.
    void
    stop();

    /// Log the end, and throw ExcUser if results have been deleted meanwhile.
    /// Call once, when is_finished(). Collective.
    void
    end();

    /// Whether the run has reached its end: the end time, or an earlier time
    /// when the soil is at rest or has left the mesh.
    bool
    is_finished() const;

    /// Write a checkpoint and return its path. Call after begin(), between two
    /// steps. Collective.
    std::filesystem::path
    write_checkpoint();

    /// Run the stages before the dynamics. Part of run(); without run(), call
    /// once before advance(). Return false if the run was stopped between two
    /// stages.
    bool
    run_static_stages();

    /// Advance by one step without output.
    void
    advance()
    {
      scheme_.advance(end_time_, RunRequest::none);
    }

    /// Write the state after an error. Return the path of the file.
    std::string
    write_last_state()
    {
      return output_.write_last_state(state_);
    }

    Output<dim> &
    output()
    {
      return output_;
    }

    const State<dim> &
    state() const
    {
      return state_;
    }

    double
    end_time() const
    {
      return end_time_;
    }

    /// Obstacles and the forces of the soil on them.
    const Contact<dim> &
    contact() const
    {
      return problem_.contact;
    }

    const ExplicitScheme<dim> &
    scheme() const
    {
      return scheme_;
    }

    const StaticStages<dim> &
    static_stages() const
    {
      return static_stages_;
    }

  private:
    void
    add_observers();
    void
    prepare();
    void
    create_points();
    Beginning
    beginning() const;
    void
    begin_run();
    void
    begin_files();
    void
    note_start(LogLevel level);
    void
    note_resume();
    void
    note_time_step(LogLevel level);
    void
    note_end();
    void
    note_stop(const std::string &reason, const std::filesystem::path &path);
    double
    end_of_run() const;
    StateList
    list_state();
    RunRequest
    local_request() const;
    bool
    handle_request(RunRequest request);

    // Parameters
    std::string  title_        = "";
    unsigned int dimension_    = dim;
    double       end_time_     = 1.;
    bool         ends_at_rest_ = true;
    std::string  parameters_; ///< all of the run, as text

    PhaseTimer          timer_;
    Log                 log_;
    State<dim>          state_;
    Problem<dim>        problem_;
    Transfer<dim>       transfer_;
    BackgroundMesh<dim> mesh_;
    ExplicitScheme<dim> scheme_;
    Output<dim>         output_;
    StaticStages<dim>   static_stages_;
    RestDetector<dim>   rest_;
    Checkpoint<dim>     checkpoint_;
    FoundCheckpoint     resumed_from_; ///< empty path in a new run
  };
} // namespace talus

#endif

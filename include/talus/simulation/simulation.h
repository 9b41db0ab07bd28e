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
  /// A submarine landslide, or any other motion of soft bodies on a mesh: sets
  /// up or resumes a run, leads it through its stages to the end time, and looks
  /// after output and checkpoints. The work is done by the parts.
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    explicit Simulation(const ParameterPreview &preview);

    /// Throw ExcUser if the parameters, which have been parsed, contradict each
    /// other. Makes mesh and points, but writes nothing.
    void
    set_up();

    /// In place of set_up(): go on from the newest checkpoint in the output
    /// folder. Throws ExcUser if there is none that fits. Writes nothing.
    void
    resume();

    /// Let run() start anew over the checkpoints of an unfinished run.
    void
    allow_overwriting()
    {
      checkpoint_.allow_overwriting();
    }

    /// Throw ExcUser if run() would refuse to write into the output folder as it
    /// is, unless another run is under way there. Writes nothing. Collective.
    void
    check_output_folder() const;

    /// Say what run() will do, with all remarks: mesh, points, cells across the
    /// thinnest body, time step, and an estimate of the wall time by some steps,
    /// after which the state is no longer that of the start. Writes nothing.
    /// Collective.
    void
    forecast();

    /// Return "1 remark" or the like; empty if none was made. For the first rank.
    std::string
    count_of_remarks() const
    {
      return log_.count_of_remarks();
    }

    /// Compute from the start, or the checkpoint, to the end of the run, with
    /// output: to the end time, or until the soil is at rest or has left the
    /// mesh. Returns false if the run was stopped before that, by a signal or by
    /// its limit of wall time; then resume() can go on.
    bool
    run();

    /// The stages before the dynamics. run() does this; to be called once
    /// before advance() by who does not call run(). Returns false if the run
    /// was stopped between two of them.
    bool
    run_static_stages();

    /// One step of the scheme, without output.
    void
    advance()
    {
      scheme_.advance(end_time_, RunRequest::none);
    }

    /// Emergency output after an error. Returns the path of the file.
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
    bool
    is_finished() const;
    void
    note_end();
    double
    end_of_run() const;
    StateList
    list_state();
    RunRequest
    local_request() const;
    bool
    handle_request(RunRequest request);
    std::filesystem::path
    write_checkpoint();

    // Parameters
    std::string  title_        = "";
    unsigned int dimension_    = dim;
    double       end_time_     = 1.;
    bool         ends_at_rest_ = true;

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
    FoundCheckpoint     resumed_from_; ///< no path in a run from the start
  };
} // namespace talus

#endif

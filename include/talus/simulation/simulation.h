#ifndef talus_simulation_simulation_h
#define talus_simulation_simulation_h

#include <talus/adaptivity/load_balance.h>
#include <talus/adaptivity/mesh_tracking.h>
#include <talus/adaptivity/splitter.h>
#include <talus/base/interrupt.h>
#include <talus/boundaries/boundaries.h>
#include <talus/boundaries/damping.h>
#include <talus/checkpoint/checkpoint.h>
#include <talus/equilibrium/equilibrium.h>
#include <talus/equilibrium/strength_reduction.h>
#include <talus/grid/grid.h>
#include <talus/grid/nodal_fields.h>
#include <talus/materials/materials.h>
#include <talus/observers/output.h>
#include <talus/observers/snapshot.h>
#include <talus/points/points.h>
#include <talus/problem/body.h>
#include <talus/problem/loading.h>
#include <talus/problem/trigger.h>
#include <talus/simulation/preview.h>
#include <talus/simulation/stages.h>
#include <talus/simulation/time_step.h>
#include <talus/transfer/null_space_filter.h>
#include <talus/transfer/relocation.h>
#include <talus/transfer/transfer.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// A submarine landslide, or any other motion of soft bodies on a mesh, by
  /// the material point method: explicit, update stress last.
  /// @cite bardenhagen2002, @cite esub
  template <int dim>
  class Simulation : public dealii::ParameterAcceptor
  {
  public:
    explicit Simulation(const Preview &preview);

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
      may_overwrite_ = true;
    }

    /// From the start, or the checkpoint, to the end time, with output. Returns
    /// false if the run was stopped before that, by a signal or by its limit of
    /// wall time; then resume() can go on.
    bool
    run();

    /// The stages before the dynamics. run() does this; to be called once
    /// before advance() by who does not call run(). Returns false if the run
    /// was stopped between two of them.
    bool
    run_static_stages();

    /// One step of the scheme.
    void
    advance();

    /// Emergency output after an error. Returns the path of the file.
    std::string
    write_last_state();

    Output<dim> &
    output()
    {
      return output_;
    }

    Snapshot<dim>
    snapshot() const;

    /// The search of the stage 'equilibrium', or of the last trial of the stage
    /// 'strength reduction'.
    const Equilibrium<dim> &
    equilibrium() const
    {
      return equilibrium_;
    }

    const StrengthReduction &
    strength_reduction() const
    {
      return strength_reduction_;
    }

  private:
    void
    set_up_laws();
    std::array<bool, 2 * dim>
    faces_that_may_move() const;
    void
    create_bodies();
    double
    least_density() const;
    void
    number_points();
    void
    prepare();
    void
    begin_run();
    void
    create_mesh();
    void
    settle();
    void
    share_out();
    void
    adapt_mesh();
    void
    note_start();
    void
    note_time_step();
    void
    choose_time_step();
    double
    allowed_time_step();
    void
    points_to_grid();
    void
    update_nodes();
    void
    grid_to_points();
    void
    split();
    void
    relocate();

    // Static stages
    void
    check_static_stages(const std::vector<std::string> &names_of_bodies) const;
    /// What a load step is told of.
    struct StepNote
    {
      unsigned int        step = 0;
      double              load = 0;
      std::vector<double> residuals;
      unsigned int        n_linear_iterations = 0;
      double              seconds             = 0;
    };
    /// What a search for equilibrium may change.
    struct StaticState
    {
      std::vector<std::vector<double>> columns; ///< of the points
      StaticContact<dim>               contact;
    };
    Soil<dim>
    soil();
    void
    find_equilibrium();
    bool
    bring_to_equilibrium(double factor, StrainMeasure measure);
    bool
    take_load_step(double factor, StepNote &note);
    void
    follow_points();
    std::string
    no_equilibrium() const;
    [[noreturn]] void
    throw_no_equilibrium(const std::string &sentence);
    StaticState
    static_state() const;
    void
    restore(const StaticState &state);
    void
    bring_back(const StaticState &state);
    void
    divide_strength(double factor);
    StrainMeasure
    measure_of_stronger_soil() const;
    void
    find_equilibrium_with_more_strength(const StaticState &before);
    void
    reduce_strength();
    void
    start_reduction();
    bool
    stands_with(double factor);
    void
    check_soil_stands() const;
    void
    observe(const EquilibriumProgress &progress, double factor, StepNote &note);
    void
    tell(const StepNote &note);
    void
    say_and_note(const std::string &sentence);

    // Checkpoints
    bool
    is_finished() const;
    double
    end_of_run() const;
    void
    restore_partition(Hdf5File &file);
    StateList
    state();
    Wish
    own_wish() const;
    bool
    act_on(Wish wish);
    std::filesystem::path
    write_checkpoint();
    void
    note_resume();
    void
    say(const std::string &sentence);

    // Parameters
    std::string              title_                 = "";
    unsigned int             dimension_             = dim;
    double                   end_time_              = 1.;
    std::string              initial_velocity_time_ = "start";
    std::vector<std::string> names_of_bodies_;

    // Floor by floor
    Constants                               constants_;
    Points<dim>                             points_;
    StepWorkspace<dim>                      workspace_;
    Grid<dim>                               grid_;
    NodalFields<dim>                        nodes_;
    Transfer<dim>                           transfer_;
    NullSpaceFilter<dim>                    filter_;
    Relocation<dim>                         relocation_;
    Materials<dim>                          materials_;
    Boundaries<dim>                         boundaries_;
    Damping<dim>                            damping_;
    Equilibrium<dim>                        equilibrium_;
    StrengthReduction                       strength_reduction_;
    Splitter<dim>                           splitter_;
    LoadBalance<dim>                        load_balance_;
    MeshTracking<dim>                       mesh_tracking_;
    std::vector<std::unique_ptr<Body<dim>>> bodies_;
    Loading<dim>                            loading_;
    Trigger<dim>                            trigger_;
    TimeStep<dim>                           time_step_;
    Stages                                  stages_;
    PhaseTimer                              timer_;
    Output<dim>                             output_;
    NewtonTable                             newton_table_;
    Checkpoint<dim>                         checkpoint_;

    // State besides points
    double            time_         = 0; ///< s
    double            dt_           = 0; ///< of the last step, s
    unsigned long     step_         = 0;
    double            gravity_work_ = 0; ///< J
    BoundaryWork<dim> boundary_work_;
    /// The soil is in balance with its strengths divided by this [-]: 1, or less
    /// where it does not stand with those that it has.
    double        standing_factor_ = 1.;
    double        least_mass_      = 0; ///< kg
    unsigned long n_mesh_changes_  = 0;
    unsigned long n_repartitions_  = 0;

    Wish            wish_ = Wish::none; // of all ranks, for after this step
    FoundCheckpoint resumed_from_;      // no path in a run from the start
    bool            may_overwrite_ = false;

    std::vector<std::string> start_notes_; // sentences for the log
  };
} // namespace talus

#endif

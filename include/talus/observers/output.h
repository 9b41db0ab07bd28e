// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_output_h
#define talus_observers_output_h

#include <talus/base/phase_timer.h>
#include <talus/io/files.h>
#include <talus/io/log.h>
#include <talus/io/output_folder.h>
#include <talus/observers/observer.h>
#include <talus/observers/points_output.h>
#include <talus/observers/progress.h>
#include <talus/observers/statistics.h>

#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Output times k * interval, k = 1, 2, ...: output is due at the first step
  /// that reaches an output time; the time step is not adjusted. The next
  /// multiple follows from the time alone, without any tolerance: a restart
  /// does not change the output times, and rounding errors do not accumulate.
  class OutputTimes
  {
  public:
    /// Start after an output at @p time, s; the next output is due after at
    /// most @p interval, s. Without an interval, 0, no output is ever due.
    void
    begin(const double interval, const double time)
    {
      interval_ = interval;
      advance(time);
    }

    /// Return true, once, when @p time has reached the next output time. A step
    /// that passes several output times counts once.
    bool
    reached(const double time)
    {
      if (!(time >= next_ * interval_))
        return false;
      advance(time);
      return true;
    }

  private:
    /// Set the next output time to the smallest multiple beyond @p time.
    void
    advance(const double time)
    {
      next_ = std::floor(time / interval_);
      // The quotient is rounded: the correct multiple may be one lower or
      // higher.
      while (next_ * interval_ > time)
        --next_;
      while (next_ * interval_ <= time)
        ++next_;
    }

    double interval_ = 1.; // s
    double next_     = 1.; // a whole number
  };



  /// All output of a run, in one folder (parameters.prm, log.txt,
  /// statistics.csv, profile.csv, points.pvd and grid.pvd with VTU files), and
  /// the progress on the terminal.
  ///
  /// Rows and fields are written at the start, at the first step that reaches
  /// each multiple of the interval (see OutputTimes) and at the last step.
  template <int dim>
  class Output : public dealii::ParameterAcceptor
  {
  public:
    /// Construct all observers. @p timer gets the section "output", see
    /// phase_times(). @p log is opened in the folder. @p obstacles may belong
    /// to the ground; null for no obstacles.
    Output(PhaseTimer           &timer,
           Log                  &log,
           const Obstacles<dim> *obstacles = nullptr);

    /// See PointsOutput::add_field().
    void
    add_point_field(const Field &field)
    {
      points_->add_field(field);
    }

    /// Add columns to statistics.csv.
    void
    add_quantities(const typename Statistics<dim>::Source &source)
    {
      statistics_->add_source(source);
    }

    /// See Statistics::set_thick_soil().
    void
    set_thick_soil(const typename Statistics<dim>::Source &source)
    {
      statistics_->set_thick_soil(source);
    }

    /// Add an observer called whenever a row of statistics.csv is due.
    void
    add_row_observer(std::unique_ptr<Observer<dim>> observer)
    {
      rows_.observers.push_back(std::move(observer));
    }

    /// Add an observer called whenever fields are due.
    void
    add_field_observer(std::unique_ptr<Observer<dim>> observer)
    {
      fields_.observers.push_back(std::move(observer));
    }

    /// Add an observer called at multiples of `Plan interval`.
    void
    add_plan_observer(std::unique_ptr<Observer<dim>> observer)
    {
      plan_.observers.push_back(std::move(observer));
    }

    /// Write to @p folder, overriding the parameter file. Call after parsing.
    void
    set_folder(const std::string &folder);

    /// Begin the energy budget anew at @p state: a static stage has changed
    /// the stress after start(). Collective.
    void
    restart_energy_budget(const State<dim> &state)
    {
      statistics_->start(state);
    }

    /// Return the row that statistics.csv would have now. Collective; complete
    /// on the first rank.
    Quantities
    statistics(const State<dim> &state) const
    {
      return statistics_->evaluate(state, settings_.write_runout);
    }

    /// Output folder, from the parameter or from set_folder().
    const std::string &
    folder() const
    {
      return folder_;
    }

    /// Throw ExcUser if the parameters contradict each other, or if runout
    /// output is requested together with @p local_damping [-], which falsifies
    /// the runout.
    void
    check(double local_damping) const;

    /// Check the parameters of all observers. Call when the mesh exists, before
    /// anything is written. Throws ExcUser. Collective.
    void
    check_observers(const State<dim> &state) const;

    /// Create the folder if needed and lock it against other runs. Throws
    /// ExcUser if another run holds the lock. Collective.
    void
    lock_folder(const MPI_Comm communicator)
    {
      lock_.acquire(folder_, communicator);
    }

    /// Leave the lock file in the folder, see FolderLock::keep().
    void
    keep_lock()
    {
      lock_.keep();
    }

    /// Throw ExcUser if the run would overwrite files of the user, or input of
    /// the run. Changes nothing. Collective.
    void
    check_folder(MPI_Comm communicator, Beginning beginning) const;

    /// Create the folder, write @p parameters to parameters.prm and open all
    /// files of a run to @p end_time, s; a resumed run continues the existing
    /// files. Throws ExcUser if the folder is not writable; then all files of
    /// an earlier run are untouched.
    void
    begin(const State<dim>  &state,
          double             end_time,
          const std::string &parameters,
          Beginning          beginning = Beginning::fresh);

    /// Write the output due at the start of the motion, unless already written.
    void
    start(const State<dim> &state);

    /// List the amount written so far as state of the run.
    void
    list_state(StateList &list);

    /// Throw ExcUser if a file needed by a resumed run is missing. Call after
    /// the state has been loaded. Collective.
    void
    check_resumable(const State<dim> &state) const;

    /// Describe the files of the run that have been deleted: 'a' with 2 more.
    /// Empty if no file is missing, and on all ranks except the first.
    std::string
    missing_files(MPI_Comm communicator) const;

    /// Throw ExcUser if files of the run are missing. Collective.
    void
    check_complete(MPI_Comm communicator) const;

    /// Force all rows and fields written so far to disk.
    void
    sync(MPI_Comm communicator);

    /// Write the output due after a step. Call after each step. In the @p last
    /// step all output is due, and the throughput is printed. Returns whether
    /// fields were written. Throws ExcUser if a file cannot be written.
    bool
    observe(const State<dim> &state, bool last);

    /// Write the points with a failure mechanism to NAME.pvd and its files.
    /// Collective.
    ///
    /// @param state of the run
    /// @param name of the series of files
    /// @param mechanism motion of the points [-], dim components per point
    void
    write_mechanism(const State<dim>          &state,
                    const std::string         &name,
                    const std::vector<double> &mechanism) const;

    /// Write the points to last-state.vtu after a fatal error. Returns the
    /// path, for the message.
    std::string
    write_last_state(const State<dim> &state) const;

  private:
    /// Observers with common output times.
    struct Schedule
    {
      double                                      interval; ///< s
      OutputTimes                                 times;
      unsigned long                               last_step = 0;
      std::vector<std::unique_ptr<Observer<dim>>> observers;

      bool
      is_due(const State<dim> &state, bool last);
    };

    void
    list_observers(const Obstacles<dim> *obstacles);
    void
    follow(const State<dim> &state);
    void
    write(Schedule &schedule, const State<dim> &state);

    // Parameters
    std::string    folder_ = "output";
    OutputSettings settings_;
    FolderLock     lock_;

    Schedule           rows_{0.25, {}, 0, {}};
    Schedule           fields_{1., {}, 0, {}};
    Schedule           plan_{0., {}, 0, {}};
    Statistics<dim>   *statistics_; ///< owned by rows_
    PointsOutput<dim> *points_;     ///< owned by fields_
    PhaseTimer        &timer_;
    Log               &log_;
    Progress           progress_;
    bool               has_started_ = false;
  };
} // namespace talus

#endif

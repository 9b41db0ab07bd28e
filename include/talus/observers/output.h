// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_output_h
#define talus_observers_output_h

#include <talus/base/phase_timer.h>
#include <talus/io/files.h>
#include <talus/io/folder_lock.h>
#include <talus/io/log.h>
#include <talus/observers/observer.h>
#include <talus/observers/output_times.h>
#include <talus/observers/progress.h>
#include <talus/observers/statistics.h>

#include <deal.II/base/parameter_acceptor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// All that a run leaves behind, in one folder: parameters.prm, log.txt,
  /// statistics.csv, profile.csv, points.pvd and grid.pvd with their VTU files
  /// (or .xdmf and HDF5 files); and the progress on the terminal.
  ///
  /// Rows and fields are written at the start, at the first step that reaches
  /// each multiple of their interval (see OutputTimes) and at the last step.
  template <int dim>
  class Output : public dealii::ParameterAcceptor
  {
  public:
    /// @p timer gets the section "output"; see phase_times(). @p log is opened
    /// in the folder. @p obstacles belong to the ground; null for none.
    Output(PhaseTimer           &timer,
           Log                  &log,
           const Obstacles<dim> *obstacles = nullptr);

    /// Add columns to statistics.csv.
    void
    add_quantities(const typename Statistics<dim>::Source &source)
    {
      statistics_->add_source(source);
    }

    /// Add one that looks whenever a row of the statistics is due.
    void
    add_row_observer(std::unique_ptr<Observer<dim>> observer)
    {
      rows_.observers.push_back(std::move(observer));
    }

    /// Add one that looks whenever fields are due.
    void
    add_field_observer(std::unique_ptr<Observer<dim>> observer)
    {
      fields_.observers.push_back(std::move(observer));
    }

    /// Write to this folder, whatever the parameter file says; to be called
    /// after parsing.
    void
    set_folder(const std::string &folder);

    /// Time over which forces on obstacles and faces are averaged, s.
    double
    force_averaging_time() const
    {
      return settings_.averaging_time;
    }

    /// As given by the parameter or by set_folder().
    const std::string &
    folder() const
    {
      return folder_;
    }

    /// Throw ExcUser if the parameters contradict each other, or if the runout
    /// is asked for while @p local_damping falsifies it.
    void
    check(double local_damping) const;

    /// Let all observers check their parameters, when the mesh is there and
    /// nothing is written. Throws ExcUser. Collective.
    void
    check_observers(const State<dim> &state) const;

    /// Let no other run write into the folder, which is made if it is not there.
    /// Throws ExcUser if one does. Collective.
    void
    lock_folder(const MPI_Comm communicator)
    {
      lock_.acquire(folder_, communicator);
    }

    /// Throw ExcUser if the folder holds what this run would write over and must
    /// not: files of the user, or what it reads. Changes nothing. Collective.
    void
    check_folder(MPI_Comm communicator, Beginning beginning) const;

    /// Make the folder, write the parameters and begin all files of a run to
    /// @p end_time, s; in a resumed run go on with them. Throws ExcUser if the
    /// folder cannot be written; then no file of an earlier run was touched.
    void
    begin(const State<dim> &state,
          double            end_time,
          Beginning         beginning = Beginning::fresh);

    /// Write all that is due at the start of the motion, unless that was done.
    void
    start(const State<dim> &state);

    /// Add what was written so far to the state of the run.
    void
    list_state(StateList &list);

    /// Throw ExcUser if a file is missing that a resumed run is to go on with;
    /// to be called when the state was loaded. Collective.
    void
    check_resumable(const State<dim> &state) const;

    /// Of the files of the run those that somebody has removed, in words: 'a'
    /// with 2 more. Empty if there are none, and on all ranks but the first.
    std::string
    missing_files(MPI_Comm communicator) const;

    /// Throw ExcUser if files are missing. Collective.
    void
    check_complete(MPI_Comm communicator) const;

    /// Bring all rows and fields written so far to the disk.
    void
    sync();

    /// To be called after each step: write what is due. At the @p last step
    /// everything is due, and the throughput is printed. Returns whether fields
    /// were written. Throws ExcUser if a file cannot be written.
    bool
    observe(const State<dim> &state, bool last);

    /// Write the points with how they move in a mechanism of failure, dim
    /// numbers for each, to NAME.pvd and its files (or .xdmf). Collective.
    void
    write_mechanism(const State<dim>          &state,
                    const std::string         &name,
                    const std::vector<double> &mechanism) const;

    /// Write the points as they are, after an error that ends the run, to
    /// last-state.vtu. Returns the path, for the message.
    std::string
    write_last_state(const State<dim> &state) const;

  private:
    /// Observers that look at the same times.
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

    Schedule         rows_{0.25, {}, 0, {}};
    Schedule         fields_{1., {}, 0, {}};
    Statistics<dim> *statistics_; ///< one of the observers
    PhaseTimer      &timer_;
    Log             &log_;
    Progress         progress_;
    bool             has_started_ = false;
  };
} // namespace talus

#endif

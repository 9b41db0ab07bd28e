// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/application/message.h>
#include <talus/application/parameter_file.h>
#include <talus/application/run.h>
#include <talus/base/errors.h>
#include <talus/simulation/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using SimulationPointer = std::unique_ptr<Simulation<dim>>;

    using AnySimulation =
      std::variant<SimulationPointer<2>, SimulationPointer<3>>;



    /// Scope in which the objects of one run declare and read their parameters.
    /// deal.II's global handler refers to members of the objects, which may
    /// live shorter than the handler, and must not meet those of another run.
    class GlobalParameters
    {
    public:
      GlobalParameters()
      {
        ParameterAcceptor::prm.clear();
      }

      GlobalParameters(const GlobalParameters &) = delete;

      ~GlobalParameters()
      {
        ParameterAcceptor::prm.clear();
      }
    };



    /// Return a function of the time for an obstacle that checks the number of
    /// components.
    template <int dim>
    typename Obstacle<dim>::VelocityOfTime
    checked_velocity(const std::string      &obstacle,
                     const ObstacleVelocity &velocity)
    {
      return [obstacle, velocity](const double time) {
        const std::vector<double> components = velocity(time);
        AssertThrow(components.size() == dim,
                    ExcUser(text("The velocity of the obstacle '",
                                 obstacle,
                                 "', prescribed by the program that leads the "
                                 "run, has ",
                                 components.size(),
                                 " components at t = ",
                                 time,
                                 " s; expected ",
                                 dim,
                                 ". Correct the function.")));
        Tensor<1, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = components[d];
        return result;
      };
    }



    /// Make all objects, which declare the parameters, fill the parameters, and
    /// set up or resume the run. Afterwards nothing refers to the global
    /// parameters.
    template <int dim>
    SimulationPointer<dim>
    make_simulation(const ParameterFile &file,
                    const RunOptions    &options,
                    const MPI_Comm       communicator)
    {
      const GlobalParameters scope;
      auto                   simulation =
        std::make_unique<Simulation<dim>>(file.preview(), communicator);
      for (const std::string &remark : file.parse())
        simulation->add_remark(remark);
      if (!options.output_folder.empty())
        simulation->output().set_folder(options.output_folder);
      if (options.overwrite)
        simulation->allow_overwriting();
      for (const auto &[name, velocity] : options.obstacle_velocities)
        simulation->prescribe_velocity(name,
                                       checked_velocity<dim>(name, velocity));
      if (options.resume)
        simulation->resume();
      else
        simulation->set_up();
      return simulation;
    }



    /// Shape of the values of a column, see PointColumn::shape.
    template <int dim>
    std::vector<unsigned int>
    shape_of(const Column &column)
    {
      if (column.kind == ColumnKind::tensor ||
          column.kind == ColumnKind::deformation)
        return {dim, dim};
      if (column.kind == ColumnKind::scalars && column.n_components == 1)
        return {};
      return {column.n_components};
    }



    template <int dim>
    std::vector<PointColumn>
    columns_of(const Points<dim> &points)
    {
      std::vector<PointColumn> result;
      for (const Column &column : points.columns())
        result.push_back({column.name,
                          column.unit,
                          shape_of<dim>(column),
                          points.size(),
                          points.data(column.first),
                          points.view().pitch,
                          points.memory()});
      return result;
    }



    template <int dim>
    Quantities
    accounts_of(const State<dim> &state)
    {
      using EnergyKind = typename Accounts<dim>::EnergyKind;
      Quantities result;
      for (const auto &energy : state.accounts.energies())
        result.push_back({energy.name,
                          "J",
                          energy.kind == EnergyKind::stored
                            ? energy.stored(state.points)
                            : energy.value});
      for (const auto &impulse : state.accounts.impulses())
        append_vector<dim>(result, impulse.name, "N s", impulse.value);
      for (Quantity &quantity : result)
        quantity.value =
          Utilities::MPI::sum(quantity.value, state.communicator());
      return result;
    }



    template <int dim>
    std::vector<double>
    components(const Tensor<1, dim> &vector, const double factor = 1.)
    {
      std::vector<double> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(factor * vector[d]);
      return result;
    }



    /// State of all obstacles. There are no reactions before the first step.
    /// The last impulses may belong to the step before the present one, if a
    /// function that prescribes a velocity asks.
    template <int dim>
    std::vector<ObstacleState>
    obstacles_of(const Simulation<dim> &simulation)
    {
      const Contact<dim>        &contact   = simulation.contact();
      const Obstacles<dim>      &obstacles = contact.obstacles();
      const double               dt        = contact.previous_time_step();
      const double               per_time  = dt > 0 ? 1. / dt : 0.;
      const double               middle    = simulation.state().time - 0.5 * dt;
      std::vector<ObstacleState> result;
      for (unsigned int k = 0; k < obstacles.size(); ++k)
        {
          const Reaction<dim> reaction = k < contact.reactions().size()
                                           ? contact.reactions()[k]
                                           : Reaction<dim>();
          std::vector<double> moment;
          for (const double angular_impulse : reaction.last.angular_impulse)
            moment.push_back(per_time * angular_impulse);
          result.push_back({obstacles[k].name(),
                            components(obstacles[k].displacement()),
                            components(obstacles[k].velocity(middle)),
                            components(reaction.last.impulse, per_time),
                            moment,
                            components(reaction.total.impulse),
                            reaction.last.area});
        }
      return result;
    }



    /// Save the last state after an error and return a sentence about it. If
    /// the saving fails, too, the first error must still be reported.
    template <int dim>
    std::string
    saved_state(Simulation<dim> &simulation)
    {
      try
        {
          const MPI_Comm     communicator = simulation.state().communicator();
          const unsigned int rank =
            Utilities::MPI::this_mpi_process(communicator);
          const bool is_alone =
            Utilities::MPI::n_mpi_processes(communicator) == 1;
          return (is_alone ? " The last state is in '"
                           : text(" The points of rank ", rank, " are in '")) +
                 simulation.write_last_state() + "'.";
        }
      catch (const ExcUser &exception)
        {
          return " The last state was not saved: " + message(exception);
        }
    }
  } // namespace



  /// Progress of a run.
  enum class Phase
  {
    set_up,  ///< before the files are begun
    begun,   ///< between two steps
    ended,   ///< at the end of the run, which has been logged
    unusable ///< after an error, a forecast, or a stop in the static stages
  };



  struct Run::Parts
  {
    AnySimulation         simulation;
    Phase                 phase = Phase::set_up;
    std::function<void()> observer;
    bool                  is_stop_requested = false;

    /// Call @p action with the simulation of the right dimension.
    template <typename Action>
    auto
    with_simulation(const Action &action) const
    {
      return std::visit([&](const auto &pointer) { return action(*pointer); },
                        simulation);
    }
  };



  Run::Run(const ParameterFile &file,
           const RunOptions    &options,
           const MPI_Comm       communicator)
    : parts_(std::make_unique<Parts>())
  {
    if (file.preview().dimension == 2)
      parts_->simulation = make_simulation<2>(file, options, communicator);
    else
      parts_->simulation = make_simulation<3>(file, options, communicator);
  }



  Run::~Run() = default;



  Run::Run(Run &&other) noexcept = default;



  void
  Run::set_observer(const std::function<void()> &observer)
  {
    parts_->observer = observer;
  }



  void
  Run::check_usable() const
  {
    AssertThrow(parts_->phase != Phase::unusable,
                ExcUser("The run in '" + output_folder() +
                        "' cannot go on in this object, after an error, a "
                        "forecast or a stop in its static stages. Make a new "
                        "run, which can resume from the newest checkpoint."));
  }



  /// Do what may leave the state between two phases of a step. An error of a
  /// point is rethrown with the place of the last state.
  template <typename Action>
  bool
  Run::lead(const Action &action)
  {
    const Phase before = std::exchange(parts_->phase, Phase::unusable);
    try
      {
        const bool result = parts_->with_simulation(action);
        parts_->phase     = before;
        return result;
      }
    catch (const ExcPoint &exception)
      {
        throw ExcPoint(message(exception) +
                       parts_->with_simulation([](auto &simulation) {
                         return saved_state(simulation);
                       }));
      }
  }



  bool
  Run::advance_to(const double time)
  {
    AssertThrow(!std::isnan(time),
                ExcUser("The run was told to advance to the time nan, where a "
                        "number of seconds was expected. Correct the time."));
    check_usable();
    parts_->is_stop_requested = false;
    if (parts_->phase == Phase::set_up)
      {
        if (!lead([](auto &simulation) { return simulation.begin(); }))
          {
            parts_->phase = Phase::unusable;
            return false;
          }
        parts_->phase = Phase::begun;
      }
    if (!advance(time))
      return false;
    if (is_finished() && parts_->phase == Phase::begun)
      {
        parts_->phase = Phase::ended;
        parts_->with_simulation([](auto &simulation) { simulation.end(); });
      }
    return true;
  }



  /// The ranks agree on a stop only where an observer can ask for one.
  bool
  Run::advance(const double time)
  {
    while (!is_finished() && this->time() < time)
      {
        if (!lead([](auto &simulation) { return simulation.step(); }))
          return false;
        if (!parts_->observer)
          continue;
        parts_->observer();
        if (is_stop_requested() && !is_finished())
          {
            parts_->with_simulation(
              [](auto &simulation) { simulation.stop(); });
            return false;
          }
      }
    return true;
  }



  bool
  Run::advance_to_end()
  {
    check_usable();
    AssertThrow(parts_->phase == Phase::set_up,
                ExcUser("The run in '" + output_folder() +
                        "' has begun already. Call advance_to() with the end "
                        "time."));
    const bool is_complete =
      lead([](auto &simulation) { return simulation.run(); });
    parts_->phase = is_complete ? Phase::ended : Phase::begun;
    return is_complete;
  }



  void
  Run::stop()
  {
    parts_->is_stop_requested = true;
  }



  bool
  Run::is_stop_requested()
  {
    return Utilities::MPI::logical_or(parts_->is_stop_requested,
                                      communicator());
  }



  std::string
  Run::write_checkpoint()
  {
    check_usable();
    AssertThrow(parts_->phase != Phase::set_up,
                ExcUser("The run in '" + output_folder() +
                        "' has not begun, so that there is nothing to write "
                        "into a checkpoint. Advance the run first."));
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.write_checkpoint().string(); });
  }



  void
  Run::check_output_folder() const
  {
    parts_->with_simulation(
      [](auto &simulation) { simulation.check_output_folder(); });
  }



  void
  Run::forecast()
  {
    check_usable();
    parts_->phase = Phase::unusable;
    parts_->with_simulation([](auto &simulation) { simulation.forecast(); });
  }



  std::string
  Run::count_of_remarks() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.count_of_remarks(); });
  }



  unsigned int
  Run::dimension() const
  {
    return parts_->simulation.index() == 0 ? 2 : 3;
  }



  MPI_Comm
  Run::communicator() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.state().communicator(); });
  }



  const std::string &
  Run::output_folder() const
  {
    return *parts_->with_simulation(
      [](auto &simulation) { return &simulation.output().folder(); });
  }



  double
  Run::time() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.state().time; });
  }



  double
  Run::end_time() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.end_time(); });
  }



  double
  Run::time_step() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.state().time_step; });
  }



  unsigned long
  Run::n_steps() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.state().step; });
  }



  bool
  Run::is_finished() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return simulation.is_finished(); });
  }



  std::vector<PointColumn>
  Run::point_columns() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return columns_of(simulation.state().points); });
  }



  Quantities
  Run::statistics() const
  {
    return parts_->with_simulation([](auto &simulation) {
      return simulation.output().statistics(simulation.state());
    });
  }



  Quantities
  Run::accounts() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return accounts_of(simulation.state()); });
  }



  std::vector<ObstacleState>
  Run::obstacles() const
  {
    return parts_->with_simulation(
      [](auto &simulation) { return obstacles_of(simulation); });
  }
} // namespace talus

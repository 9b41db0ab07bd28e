// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/fracture.h>
#include <talus/observers/point_motion.h>
#include <talus/observers/statistics.h>

namespace talus
{
  template <int dim>
  Statistics<dim>::Statistics(const Obstacles<dim> *obstacles)
    : TableObserver<dim>(file_name)
    , obstacles_(obstacles)
  {}



  template <int dim>
  void
  Statistics<dim>::add_source(const Source &source)
  {
    sources_.push_back(source);
  }



  /// Names and values come from the same list, so header and rows cannot
  /// differ. doc/output.md describes the columns.
  template <int dim>
  Quantities
  Statistics<dim>::evaluate(const State<dim> &state,
                            const bool        with_runout) const
  {
    Quantities        row = {{"time", "s", state.time},
                             {"step", "", static_cast<double>(state.step)},
                             {"time step", "s", state.time_step}};
    const Ground<dim> ground(state.grid.domain(), obstacles_);
    list_motion(state, ground, with_runout, row);
    seabed_force_.list_quantities(state, row);
    const Quantities energies = budget_.evaluate(state);
    row.insert(row.end(), energies.begin(), energies.end());
    list_fractures(state, ground, row);
    for (const Source &source : sources_)
      source(state, row);
    return row;
  }



  template <int dim>
  void
  Statistics<dim>::begin(const OutputSettings &settings,
                         const State<dim>     &state,
                         const Beginning       beginning)
  {
    has_runout_ = settings.write_runout;
    TableObserver<dim>::begin(settings, state, beginning);
  }



  /// Called after the static stages, whose energies do not count.
  template <int dim>
  void
  Statistics<dim>::start(const State<dim> &state)
  {
    budget_.begin(state);
    seabed_force_.restart(state);
  }



  /// The next mean of the seabed force begins at each row.
  template <int dim>
  void
  Statistics<dim>::observe(const State<dim> &state)
  {
    std::vector<double> values;
    for (const Quantity &quantity : evaluate(state, has_runout_))
      values.push_back(quantity.value);
    this->add_rows(state, {values});
    seabed_force_.restart(state);
  }



  /// Drop the values of the evaluation: the headings are needed once per run.
  template <int dim>
  std::vector<std::string>
  Statistics<dim>::names(const State<dim> &state, const bool with_runout) const
  {
    std::vector<std::string> result;
    for (const Quantity &quantity : evaluate(state, with_runout))
      result.push_back(quantity.heading());
    return result;
  }



  template <int dim>
  void
  Statistics<dim>::list_state(StateList &list)
  {
    seabed_force_.list_state(list);
    TableObserver<dim>::list_state(list);
    budget_.list_state(list);
  }



  template <int dim>
  std::vector<std::string>
  Statistics<dim>::columns(const OutputSettings &settings,
                           const State<dim>     &state) const
  {
    return names(state, settings.write_runout);
  }



  template class Statistics<2>;
  template class Statistics<3>;
} // namespace talus

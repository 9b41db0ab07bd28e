// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/fracture.h>
#include <talus/observers/point_motion.h>
#include <talus/observers/statistics.h>

namespace talus
{
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



  template class Statistics<2>;
  template class Statistics<3>;
} // namespace talus

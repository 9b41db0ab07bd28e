// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/lines.h>
#include <talus/maps/map_observers.h>
#include <talus/maps/maps.h>
#include <talus/maps/plan_series.h>
#include <talus/maps/runout.h>
#include <talus/maps/stations.h>

namespace talus
{
  template <int dim>
  void
  add_map_observers(Problem<dim> &problem, Output<dim> &output)
  {
    const auto settings = std::make_shared<MapSettings>();
    const auto list     = std::make_shared<StationList<dim>>();
    output.add_field_observer(std::make_unique<Maps<dim>>(problem, settings));
    auto runout = std::make_unique<Runout<dim>>(problem.origin());
    output.set_thick_soil(
      [&runout = *runout](const State<dim> &state, Quantities &list) {
        runout.list_thick_soil(state, list);
      });
    output.add_row_observer(std::move(runout));
    output.add_row_observer(std::make_unique<Stations<dim>>(problem, list));
    output.add_field_observer(
      std::make_unique<Lines<dim>>(problem, settings, list));
    output.add_plan_observer(
      std::make_unique<PlanSeries<dim>>(problem, settings));
  }



  template decltype(add_map_observers<2>) add_map_observers<2>;
  template decltype(add_map_observers<3>) add_map_observers<3>;
} // namespace talus

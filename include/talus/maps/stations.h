// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_stations_h
#define talus_maps_stations_h

#include <talus/maps/station_list.h>
#include <talus/observers/quantity_table.h>
#include <talus/problem/problem.h>

#include <memory>

namespace talus
{
  /// Table stations.csv: soil passing the places of the user, a row whenever a
  /// row of the statistics is due. doc/output.md lists the columns.
  template <int dim>
  class Stations : public QuantityTable<dim>
  {
  public:
    Stations(const Problem<dim>                     &problem,
             std::shared_ptr<const StationList<dim>> list);

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return list_->has_points();
    }

    void
    check(const State<dim> &state) const override;

    void
    list_state(StateList &list) override;

    Quantities
    evaluate(const State<dim> &state) const override;

  private:
    const Problem<dim>                     &problem_;
    std::shared_ptr<const StationList<dim>> list_;
  };
} // namespace talus

#endif

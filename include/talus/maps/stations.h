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
             std::shared_ptr<const StationList<dim>> list)
      : QuantityTable<dim>("stations.csv")
      , problem_(problem)
      , list_(std::move(list))
    {}

    bool
    is_enabled(const OutputSettings & /*settings*/) const override
    {
      return list_->has_points();
    }

    void
    check(const State<dim> &state) const override
    {
      list_->points(state.grid.domain_before_growth(), problem_.origin());
    }

    void
    list_state(StateList &list) override
    {
      // Without stations there is no file, and the checkpoint has no entry.
      if (list_->has_points())
        TableObserver<dim>::list_state(list);
    }

    Quantities
    evaluate(const State<dim> &state) const override;

  private:
    const Problem<dim>                     &problem_;
    std::shared_ptr<const StationList<dim>> list_;
  };
} // namespace talus

#endif

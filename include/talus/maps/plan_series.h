// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_plan_series_h
#define talus_maps_plan_series_h

#include <talus/maps/column_sums.h>
#include <talus/maps/map_axes.h>
#include <talus/observers/table_observer.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Series plan.csv: soil in each column of the maps in time, from which tools
  /// make further files, such as the source of a tsunami model. Each output
  /// appends a row for the whole soil, column -1, and a row for each column
  /// with soil; doc/output.md explains both this table and plan-cells.csv, the
  /// places of the columns.
  template <int dim>
  class PlanSeries : public TableObserver<dim>
  {
  public:
    PlanSeries(const Problem<dim>                &problem,
               std::shared_ptr<const MapSettings> maps)
      : TableObserver<dim>("plan.csv")
      , problem_(problem)
      , maps_(std::move(maps))
    {}

    bool
    is_enabled(const OutputSettings &settings) const override
    {
      return settings.plan_interval > 0;
    }

    void
    check(const State<dim> &state) const override
    {
      map_axes(problem_, state, *maps_);
    }

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    void
    observe(const State<dim> &state) override;

  private:
    std::vector<std::string>
    columns(const OutputSettings &settings,
            const State<dim>     &state) const override;
    void
    write_cells(const std::filesystem::path &folder,
                const MapAxes<dim>          &axes) const;

    const Problem<dim>                &problem_;
    std::shared_ptr<const MapSettings> maps_;
    std::unique_ptr<ColumnSums<dim>>   sums_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/coordinate_system.h>
#include <talus/maps/plan_series.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Write the cells of the columns as a table of one row, and the coordinate
  /// system of the map in a file .prj, as GIS do. A 2-D section has a single
  /// row of cells, without a height on the map.
  template <int dim>
  void
  PlanSeries<dim>::write_cells(const std::filesystem::path &folder,
                               const MapAxes<dim>          &axes) const
  {
    MapAxes<3> plan;
    plan[1].size = 0.;
    for (unsigned int a = 0; a < dim - 1; ++a)
      plan[a] = {axes[a].lower, axes[a].size, axes[a].number};
    const Raster frame = map_frame(plan, problem_.origin());
    write_file(folder / "plan-cells.csv", [&](std::ostream &out) {
      out << "west [m],south [m],dx [m],dy [m],columns,rows\n";
      for (const double length : {frame.west, frame.south, frame.dx, frame.dy})
        out << csv_field(length) << ',';
      out << frame.n_columns << ',' << frame.n_rows << '\n';
    });
    if (const Raster *raster = problem_.surfaces().raster(maps_->raster());
        raster != nullptr && !raster->coordinate_system.empty())
      write_file(folder / "plan-cells.prj", [&](std::ostream &out) {
        out << well_known_text(raster->coordinate_system) << '\n';
      });
  }



  template <int dim>
  void
  PlanSeries<dim>::begin(const OutputSettings &settings,
                         const State<dim>     &state,
                         const Beginning       beginning)
  {
    const MapAxes<dim> axes = map_axes(problem_, state, *maps_);
    sums_                   = std::make_unique<ColumnSums<dim>>(
      std::make_shared<LatticeColumns<dim>>(axes));
    if (is_first_rank(state.communicator()))
      write_cells(settings.folder, axes);
    TableObserver<dim>::begin(settings, state, beginning);
  }



  template <int dim>
  std::vector<std::string>
  PlanSeries<dim>::columns(const OutputSettings & /*settings*/,
                           const State<dim> & /*state*/) const
  {
    std::vector<std::string> names = {
      "time [s]", "column", dim == 2 ? "volume [m^2]" : "volume [m^3]"};
    const std::string per_width = (dim == 2 ? "/m]" : "]");
    names.push_back("mass [kg" + per_width);
    for (unsigned int d = 0; d < dim; ++d)
      names.push_back(text("momentum ", "xyz"[d], " [N s", per_width));
    return names;
  }



  /// The volume of the whole soil is a sum over points, independent of the
  /// columns, so that tools can check the columns.
  template <int dim>
  void
  PlanSeries<dim>::observe(const State<dim> &state)
  {
    ColumnSum<dim> total;
    for (unsigned int p = 0; p < state.points.size(); ++p)
      total.volume += volume_of_points<dim, double>(state.points, p);
    total.volume = Utilities::MPI::sum(total.volume, state.communicator());
    sums_->sum_soil(state);
    sums_->sum_over_ranks(state.communicator());
    std::vector<unsigned int> columns = sums_->with_soil();
    std::sort(columns.begin(), columns.end());
    for (const unsigned int column : columns)
      {
        total.mass += (*sums_)[column].mass;
        total.momentum += (*sums_)[column].momentum;
      }
    std::vector<std::vector<double>> rows;
    const auto add = [&](const double column, const ColumnSum<dim> &sum) {
      rows.push_back({state.time, column, sum.volume, sum.mass});
      for (unsigned int d = 0; d < dim; ++d)
        rows.back().push_back(sum.momentum[d]);
    };
    add(-1, total);
    for (const unsigned int column : columns)
      add(column, (*sums_)[column]);
    this->add_rows(state, rows);
  }



  template class PlanSeries<2>;
  template class PlanSeries<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/column_sums.h>
#include <talus/maps/pore_columns.h>
#include <talus/maps/stations.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Append the quantities of a column; zeros without soil.
    template <int dim>
    void
    list_station(const std::string      &name,
                 const ColumnSums<dim>  &sums,
                 const PoreColumns<dim> &pore,
                 const unsigned int      column,
                 const ImpactFormula    &impact,
                 Quantities             &row)
    {
      const bool           has_soil  = sums[column].mass > 0;
      const double         thickness = sums.thickness(column);
      const Tensor<1, dim> velocity =
        has_soil ? sums.velocity(column) : Tensor<1, dim>();
      const double strength = has_soil ? sums.strength(column) : 0.;
      row.push_back({name + " thickness", "m", thickness});
      append_vector<dim>(row, name + " depth-mean velocity", "m/s", velocity);
      row.push_back({name + " flux", "m^2/s", thickness * velocity.norm()});
      row.push_back({name + " momentum flux",
                     "N/m",
                     has_soil ? sums.momentum_flux(column) : 0.});
      row.push_back({name + " shear strength", "Pa", strength});
      if (pore.is_used())
        {
          row.push_back({name + " largest pore pressure ratio",
                         "-",
                         has_soil ? pore.largest_ratio(column) : 0.});
          row.push_back({name + " excess pore pressure at the bed",
                         "Pa",
                         has_soil ? pore.at_bed(column) : 0.});
        }
      if (impact.is_used())
        row.push_back(
          {name + " impact pressure",
           "Pa",
           has_soil
             ? impact.pressure(sums.density(column), velocity.norm(), strength)
             : 0.});
    }
  } // namespace



  template <int dim>
  Quantities
  Stations<dim>::evaluate(const State<dim> &state) const
  {
    const auto stations =
      list_->points(state.grid.domain_before_growth(), problem_.origin());
    std::vector<Point<dim>> places;
    for (const auto &station : stations)
      places.push_back(station.corners[0]);
    ColumnSums<dim> sums(std::make_shared<SquareColumns<dim>>(
      places, list_->width(state.grid.cell_size())));
    sums.sum_soil(state, &problem_.materials);
    sums.sum_over_ranks(state.communicator());
    PoreColumns<dim> pore;
    pore.find(state, sums.columns());
    Quantities row = {{"time", "s", state.time}};
    for (unsigned int i = 0; i < stations.size(); ++i)
      list_station(stations[i].name, sums, pore, i, list_->impact(), row);
    return row;
  }



  template class Stations<2>;
  template class Stations<3>;
} // namespace talus

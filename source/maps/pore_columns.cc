// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/nodal_pore_pressure.h>
#include <talus/maps/column_sums.h>
#include <talus/maps/pore_columns.h>
#include <talus/observers/boxes.h>
#include <talus/observers/pore_pressure_ratio.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  /// The first pass finds the base of the soil, the lowest edge of a box; the
  /// second pass fits the pressure of the points up to a cell above.
  template <int dim>
  void
  PoreColumns<dim>::find(const State<dim>       &state,
                         const PlanColumns<dim> &columns)
  {
    const Points<dim> &points = state.points;
    const unsigned int n    = points.have_pore_pressure() ? columns.size() : 0;
    constexpr double   none = std::numeric_limits<double>::lowest();
    ratio_.assign(n, none);
    at_bed_.assign(n, std::numeric_limits<double>::quiet_NaN());
    if (n == 0)
      return;
    Footprints<dim> footprints;
    ColumnShares    shares;
    const auto      for_each_share = [&](const auto &action) {
      points.for_each_batch([&](const Batch &batch) {
        find_shares(state, batch, columns, footprints, shares);
        for (const ColumnShare &share : shares)
          action(batch.begin + share.item, share);
      });
    };
    const auto          ratios = pore_pressure_ratio(points);
    const double *const y      = points.data(points.position, 1);
    std::vector<double> depth(n, none); // of the base below y = 0, m
    for_each_share([&](const unsigned int p, const ColumnShare &share) {
      double &ratio = ratio_[share.column], &base = depth[share.column];
      ratio = std::max(ratio, ratios[p]);
      base  = std::max(base, 0.5 * box_lengths(state, p)[1] - y[p]);
    });
    Utilities::MPI::max(ratio_, state.communicator(), ratio_);
    Utilities::MPI::max(depth, state.communicator(), depth);

    const double             h = state.grid.finest_size();
    std::vector<PressureFit> fits(n);
    for_each_share([&](const unsigned int p, const ColumnShare &share) {
      const double height = y[p] + depth[share.column];
      if (height < h)
        fits[share.column].add(share.share *
                                 volume_of_points<dim, double>(points, p),
                               points.data(points.pore_pressure())[p],
                               height);
    });
    static_assert(sizeof(PressureFit) == 5 * sizeof(double),
                  "sums go through MPI as numbers");
    const ArrayView<double> sums(&fits[0].V, 5 * n);
    Utilities::MPI::sum(ArrayView<const double>(sums),
                        state.communicator(),
                        sums);
    for (unsigned int column = 0; column < n; ++column)
      if (fits[column].V > 0.)
        at_bed_[column] = fits[column].at(0., h);
      else
        ratio_[column] = at_bed_[column];
  }



  template class PoreColumns<2>;
  template class PoreColumns<3>;
} // namespace talus

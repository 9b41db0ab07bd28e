// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/ground.h>
#include <talus/maps/bed_columns.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  /// Add a place of the bed, distributed over a cell around the place.
  template <int dim>
  void
  BedColumns<dim>::add(const BedPlace<dim>    &place,
                       const double            share_left,
                       const double            h,
                       const PlanColumns<dim> &columns)
  {
    footprint_.resize(1);
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        footprint_.centre[a][0] = place.x[axis_of_plan<dim>(a)];
        footprint_.half[a][0]   = 0.5 * h;
      }
    shares_.clear();
    columns.find_shares(footprint_, shares_);
    for (const ColumnShare &share : shares_)
      {
        const double area = share.share * place.area;
        area_[share.column] += area;
        slip_[share.column] += area * place.slip;
        share_[share.column] += area * share_left;
      }
  }



  template <int dim>
  void
  BedColumns<dim>::sum(const State<dim>       &state,
                       const Problem<dim>     &problem,
                       const PlanColumns<dim> &columns)
  {
    const Seabed<dim>    &seabed    = problem.boundaries.seabed();
    const BedSlip<dim>   &facets    = problem.contact.slip();
    const Obstacles<dim> &obstacles = problem.obstacles;
    const double          h         = state.grid.finest_size();
    const unsigned int    n =
      (seabed.keeps_slip() || obstacles.soften() || facets.has_region()
         ? columns.size()
         : 0);
    for (auto *sums : {&area_, &slip_, &share_})
      sums->assign(n, 0.);
    if (n == 0)
      return;
    seabed.slip().for_each([&](const BedPlace<dim> &place) {
      if (place.key[2] == bottom_face)
        add(place, seabed.bed().share_left(place.state()), h, columns);
    });
    const Ground<dim> ground(state.grid.domain(), &obstacles);
    facets.for_each([&](const BedPlace<dim> &place) {
      const unsigned int k = place.key[2];
      if (ground.contains(k))
        add(place, obstacles[k].bed().share_left(place.state()), h, columns);
    });
    for (auto *sums : {&area_, &slip_, &share_})
      Utilities::MPI::sum(*sums, state.communicator(), *sums);
  }



  template class BedColumns<2>;
  template class BedColumns<3>;
} // namespace talus

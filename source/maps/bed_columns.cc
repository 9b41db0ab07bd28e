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
    const double       h = state.grid.finest_size();
    const unsigned int n = (problem.contact.keeps_slip() ? columns.size() : 0);
    for (auto *sums : {&area_, &slip_, &share_})
      sums->assign(n, 0.);
    if (n == 0)
      return;
    const Ground<dim> ground(state.grid.domain(), &problem.obstacles);
    problem.contact.slip().for_each([&](const BedPlace<dim> &place) {
      const unsigned int bed = place.bed();
      if (bed == 0 ? place.key[3] == bottom_face : ground.contains(bed - 1))
        add(place, problem.beds()[bed]->share_left(place.state()), h, columns);
    });
    for (auto *sums : {&area_, &slip_, &share_})
      Utilities::MPI::sum(*sums, state.communicator(), *sums);
  }



  template class BedColumns<2>;
  template class BedColumns<3>;
} // namespace talus

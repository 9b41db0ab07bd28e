// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/maps/column_sums.h>
#include <talus/observers/boxes.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <type_traits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return whether points of the batch can overlap a column. Points outside
    /// of the mesh are assigned to the outermost cells, and may then be missed.
    template <int dim>
    bool
    may_reach(const State<dim>       &state,
              const Batch            &batch,
              const PlanColumns<dim> &columns)
    {
      for (const Segment &segment : state.points.segments(batch))
        {
          const Cell<dim> &cell   = state.grid.cells()[segment.cell];
          const double     margin = 0.5 * longest_box(state, cell.size);
          Box<dim>         reach  = cell.box();
          for (unsigned int d = 0; d < dim; ++d)
            {
              reach.lower[d] -= margin;
              reach.upper[d] += margin;
            }
          if (columns.may_reach(reach))
            return true;
        }
      return false;
    }



    /// The length of the boxes is limited to the length that the weights allow.
    template <int dim>
    void
    find_footprints(const State<dim> &state,
                    const Batch      &batch,
                    Footprints<dim>  &footprints)
    {
      const Points<dim> &points = state.points;
      const unsigned int n      = batch.end - batch.begin;
      footprints.resize(n);
      for (unsigned int a = 0; a < dim - 1; ++a)
        {
          const unsigned int  d = axis_of_plan<dim>(a);
          const double *const length =
            points.data(points.box_length, d) + batch.begin;
          std::copy_n(points.data(points.position, d) + batch.begin,
                      n,
                      footprints.centre[a].begin());
          double *const half = footprints.half[a].data();
          for (unsigned int i = 0; i < n; ++i)
            half[i] = 0.5 * length[i];
        }
      for (const Segment &segment : points.segments(batch))
        {
          const double longest =
            longest_box(state, state.grid.cells()[segment.cell].size);
          for (unsigned int a = 0; a < dim - 1; ++a)
            for (unsigned int p = segment.begin; p < segment.end; ++p)
              {
                double &half = footprints.half[a][p - batch.begin];
                half         = std::min(half, 0.5 * longest);
              }
        }
    }
  } // namespace



  template <int dim>
  void
  find_shares(const State<dim>       &state,
              const Batch            &batch,
              const PlanColumns<dim> &columns,
              Footprints<dim>        &footprints,
              ColumnShares           &shares)
  {
    shares.clear();
    if (!may_reach(state, batch, columns))
      return;
    find_footprints(state, batch, footprints);
    columns.find_shares(footprints, shares);
  }



  template <int dim>
  void
  ColumnSums<dim>::find_strengths(const State<dim>     &state,
                                  const Materials<dim> &materials,
                                  const Batch          &batch)
  {
    strengths_.resize(batch.end - batch.begin);
    materials.for_each_material_range(
      state.points,
      batch,
      [&](const MaterialModel<dim> &material,
          const unsigned int        begin,
          const unsigned int        end) {
        for (unsigned int p = begin; p < end; ++p)
          strengths_[p - batch.begin] =
            material.shear_strength(state.points, p);
      });
  }



  template <int dim>
  void
  ColumnSums<dim>::add_batch(const State<dim> &state, const Batch &batch)
  {
    const Points<dim>              &points = state.points;
    const double *const             mass   = points.data(points.mass);
    std::array<const double *, dim> velocity;
    for (unsigned int d = 0; d < dim; ++d)
      velocity[d] = points.data(points.velocity, d);
    volumes_.resize(batch.end - batch.begin);
    for_each_simd(batch.begin,
                  batch.end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    store(volumes_.data() + (p - batch.begin),
                          volume_of_points<dim, decltype(number)>(points, p));
                  });
    for (const ColumnShare &share : shares_)
      {
        const unsigned int p      = batch.begin + share.item;
        const double       volume = share.share * volumes_[share.item];
        const double       m      = share.share * mass[p];
        ColumnSum<dim>    &sum    = touch(share.column);
        sum.volume += volume;
        sum.mass += m;
        if (!strengths_.empty())
          sum.strength += volume * strengths_[share.item];
        for (unsigned int d = 0; d < dim; ++d)
          sum.momentum[d] += m * velocity[d][p];
      }
  }



  template <int dim>
  void
  ColumnSums<dim>::sum_soil(const State<dim>     &state,
                            const Materials<dim> *materials)
  {
    clear();
    strengths_.clear();
    state.points.for_each_batch([&](const Batch &batch) {
      find_shares(state, batch, *columns_, footprints_, shares_);
      if (shares_.begin() == shares_.end())
        return;
      if (materials != nullptr)
        find_strengths(state, *materials, batch);
      add_batch(state, batch);
    });
    with_soil_ = touched_;
  }



  template <int dim>
  void
  ColumnSums<dim>::add_bed_force(const Tensor<1, dim> &force,
                                 const Box<dim>       &box)
  {
    footprints_.resize(1);
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        const unsigned int d     = axis_of_plan<dim>(a);
        footprints_.centre[a][0] = 0.5 * (box.lower[d] + box.upper[d]);
        footprints_.half[a][0]   = 0.5 * box.length(d);
      }
    shares_.clear();
    columns_->find_shares(footprints_, shares_);
    for (const ColumnShare &share : shares_)
      touch(share.column).bed_force += share.share * force;
  }



  /// All columns between the first and the last column touched by any rank are
  /// summed in a single reduction: the soil covers a compact part of the map,
  /// and messages to determine the columns shared by ranks would cost more.
  template <int dim>
  void
  ColumnSums<dim>::sum_over_ranks(const MPI_Comm communicator)
  {
    static_assert(std::is_trivially_copyable_v<Tensor<1, dim>> &&
                    sizeof(ColumnSum<dim>) == (3 + 2 * dim) * sizeof(double),
                  "sums go through MPI as numbers");
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    // A single maximum determines the first and the last column.
    const double none    = std::numeric_limits<double>::lowest();
    double       ends[2] = {none, none};
    for (const unsigned int column : touched_)
      {
        ends[0] = std::max(ends[0], -double(column));
        ends[1] = std::max(ends[1], double(column));
      }
    MPI_Allreduce(MPI_IN_PLACE, ends, 2, MPI_DOUBLE, MPI_MAX, communicator);
    if (ends[1] == none)
      return;
    const unsigned int first = -ends[0], n = ends[1] - first + 1;
    double *const      data  = reinterpret_cast<double *>(&sums_[first]);
    const int          count = n * (sizeof(ColumnSum<dim>) / sizeof(double));
    const bool is_first = (Utilities::MPI::this_mpi_process(communicator) == 0);
    MPI_Reduce(is_first ? MPI_IN_PLACE : data,
               data,
               count,
               MPI_DOUBLE,
               MPI_SUM,
               0,
               communicator);
    if (!is_first)
      return;
    touched_.clear();
    with_soil_.clear();
    for (unsigned int column = first; column < first + n; ++column)
      {
        touched_.push_back(column);
        if (sums_[column].mass > 0)
          with_soil_.push_back(column);
      }
  }



  template decltype(find_shares<2>) find_shares<2>;
  template decltype(find_shares<3>) find_shares<3>;
  template class ColumnSums<2>;
  template class ColumnSums<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/contact/ground.h>
#include <talus/observers/footprint.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Plan view of the soil (dim-1 axes): columns along y on a lattice through
    /// the lower corner of the mesh, with a mark per column for soil.
    template <int dim>
    class PlanOfSoil
    {
    public:
      explicit PlanOfSoil(const State<dim> &state)
        : width_(0.25 * state.grid.finest_size())
        , origin_(state.grid.domain().lower)
      {
        find_extent(state);
        for_each_box(state, [this](const Columns &first, const Columns &last) {
          mark(first, last);
        });
        const int error = MPI_Allreduce(MPI_IN_PLACE,
                                        has_soil_.data(),
                                        has_soil_.size(),
                                        MPI_UNSIGNED_CHAR,
                                        MPI_BOR,
                                        state.communicator());
        AssertThrowMPI(error);
      }

      double
      width() const
      {
        return width_;
      }

      /// Call action(x, n) for squares of 4 x 4 columns, n > 0 of which have
      /// soil. x is the middle of the square in plan; x[1] is the bottom of the
      /// mesh. The squares are distributed over the ranks.
      template <typename Action>
      void
      for_each_square(const MPI_Comm communicator, const Action &action) const
      {
        constexpr long     side = 4;
        const unsigned int rank =
                             Utilities::MPI::this_mpi_process(communicator),
                           n_rank =
                             Utilities::MPI::n_mpi_processes(communicator);
        const long   n_x = n_[0], n_z = (dim == 2 ? 1 : n_[dim - 2]);
        unsigned int k = 0;
        for (long z = 0; z < n_z; z += side)
          for (long x = 0; x < n_x; x += side)
            {
              unsigned int n = 0;
              for (long j = z; j < std::min(z + side, n_z); ++j)
                for (long i = x; i < std::min(x + side, n_x); ++i)
                  n += has_soil_[j * n_x + i];
              if (n == 0 || k++ % n_rank != rank)
                continue;
              Point<dim> middle = origin_;
              middle[0] += (first_[0] + x + 0.5 * side) * width_;
              if (dim == 3)
                middle[axis(dim - 2)] +=
                  (first_[dim - 2] + z + 0.5 * side) * width_;
              action(middle, n);
            }
      }

    private:
      using Columns = std::array<long, dim - 1>;

      /// Return the axis of the mesh for axis @p d of the plan: x or z.
      static unsigned int
      axis(const unsigned int d)
      {
        return d == 0 ? 0 : 2;
      }

      /// Call action(first, last) for each box with the range of columns whose
      /// middles lie under the box. The length of a box is limited to the
      /// length of the cell.
      template <typename Action>
      void
      for_each_box(const State<dim> &state, const Action &action) const
      {
        const Points<dim> &points = state.points;
        points.for_each_point([&](const Segment     &segment,
                                  const unsigned int p) {
          const double half_cell = 0.5 * state.grid.cells()[segment.cell].size;
          const auto   half      = half_lengths_of_box(points, p);
          Columns      first, last;
          for (unsigned int d = 0; d < dim - 1; ++d)
            {
              const unsigned int a = axis(d);
              const double x = points.data(points.position, a)[p] - origin_[a];
              const double reach = std::min(half[a], half_cell);
              first[d] = std::lround(std::ceil((x - reach) / width_ - 0.5));
              last[d]  = std::lround(std::floor((x + reach) / width_ - 0.5));
            }
          action(first, last);
        });
      }

      /// Determine the range of columns under the boxes of all ranks.
      /// Collective.
      void
      find_extent(const State<dim> &state)
      {
        // Upper ends are stored with opposite sign, so that a single minimum
        // serves lower and upper ends.
        std::array<long, 2 * (dim - 1)> ends;
        ends.fill(std::numeric_limits<long>::max());
        for_each_box(state, [&](const Columns &first, const Columns &last) {
          for (unsigned int d = 0; d < dim - 1; ++d)
            {
              ends[2 * d]     = std::min(ends[2 * d], first[d]);
              ends[2 * d + 1] = std::min(ends[2 * d + 1], -last[d]);
            }
        });
        const int error = MPI_Allreduce(MPI_IN_PLACE,
                                        ends.data(),
                                        ends.size(),
                                        MPI_LONG,
                                        MPI_MIN,
                                        state.communicator());
        AssertThrowMPI(error);
        std::size_t n_all = 1;
        for (unsigned int d = 0; d < dim - 1; ++d)
          {
            const bool has_points =
              ends[2 * d] < std::numeric_limits<long>::max();
            first_[d] = (has_points ? ends[2 * d] : 0);
            n_[d]     = (has_points ? -ends[2 * d + 1] - first_[d] + 1 : 0);
            n_all *= n_[d];
          }
        has_soil_.assign(n_all, 0);
      }

      /// Mark the columns from @p first to @p last, inclusive.
      void
      mark(const Columns &first, const Columns &last)
      {
        const long z_first = (dim == 2 ? 0 : first[dim - 2] - first_[dim - 2]),
                   z_last  = (dim == 2 ? 0 : last[dim - 2] - first_[dim - 2]);
        for (long z = z_first; z <= z_last; ++z)
          for (long x = first[0] - first_[0]; x <= last[0] - first_[0]; ++x)
            has_soil_[z * n_[0] + x] = 1;
      }

      double                     width_;
      Point<dim>                 origin_;
      Columns                    first_, n_;
      std::vector<unsigned char> has_soil_;
    };



    /// Area of the ground under the soil, m^(dim-1). Walls and overhangs do not
    /// count. Collective.
    template <int dim>
    double
    footprint(const State<dim> &state, const Ground<dim> &ground)
    {
      const PlanOfSoil<dim> plan(state);
      double                n_columns = 0;
      plan.for_each_square(state.communicator(),
                           [&](const Point<dim> &x, const unsigned int n) {
                             n_columns += (ground.is_bottom_face()
                                             ? n
                                             : n / ground.layer_normal(x)[1]);
                           });
      return std::pow(plan.width(), dim - 1.) *
             Utilities::MPI::sum(n_columns, state.communicator());
    }



    /// Area of the ground on which soil acted in the last step, m^(dim-1), with
    /// the same exclusions as footprint(). Collective.
    template <int dim>
    double
    contact_area(const State<dim>   &state,
                 const Contact<dim> &contact,
                 const Ground<dim>  &ground)
    {
      const auto &facets   = contact.facets().owned();
      const auto &impulses = contact.impulses();
      double      area     = 0;
      for (unsigned int c = 0; c < facets.size(); ++c)
        if (ground.contains(facets[c].obstacle) &&
            facets[c].normal[1] >= Ground<dim>::min_vertical)
          area += impulses[c].area;
      for (unsigned int i = 0; i < contact.face_nodes().size(); ++i)
        if (contact.face_nodes()[i].face == bottom_face)
          area += impulses[facets.size() + i].area;
      return Utilities::MPI::sum(area, state.communicator());
    }
  } // namespace



  template <int dim>
  void
  list_contact_area(const State<dim>      &state,
                    const Boundaries<dim> &boundaries,
                    const Contact<dim>    &contact,
                    Quantities            &row)
  {
    const bool has_obstacles = !contact.obstacles().empty();
    double     in_contact = 0, under_soil = 0;
    if (boundaries.has_seabed() || has_obstacles)
      {
        const Ground<dim> ground(state.grid.domain(),
                                 has_obstacles ? &contact.obstacles()
                                               : nullptr);
        in_contact = contact_area(state, contact, ground);
        under_soil = footprint(state, ground);
      }
    const std::string unit = (dim == 2 ? "m" : "m^2");
    row.push_back({"contact area", unit, in_contact});
    row.push_back({"footprint", unit, under_soil});
  }



  template decltype(list_contact_area<2>) list_contact_area<2>;
  template decltype(list_contact_area<3>) list_contact_area<3>;
} // namespace talus

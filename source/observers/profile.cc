// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/boxes.h>
#include <talus/observers/cell_lattice.h>
#include <talus/observers/profile.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/map.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Sums over the soil of a column. Volume, mass and momentum add up by
    /// fractions of boxes; lowest and highest are edges of whole boxes, because
    /// a box has the full height in each of its columns.
    struct Sums
    {
      double lowest     = std::numeric_limits<double>::max();    // m
      double highest    = std::numeric_limits<double>::lowest(); // m
      double volume     = 0;                                     // m^dim
      double mass       = 0;                                     // kg
      double momentum_x = 0, momentum_z = 0;

      /// Add the fraction @p share of volume, mass and momentum of @p more.
      void
      add(const Sums &more, const double share = 1.)
      {
        lowest  = std::min(lowest, more.lowest);
        highest = std::max(highest, more.highest);
        volume += share * more.volume;
        mass += share * more.mass;
        momentum_x += share * more.momentum_x;
        momentum_z += share * more.momentum_z;
      }

      /// Serialize for MPI messages.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &lowest &highest &volume &mass &momentum_x &momentum_z;
      }
    };

    /// Sums by column, in the order of the columns.
    using Columns = std::map<std::uint64_t, Sums>;



    /// Contribution of the whole point @p p, with @p half_height of the box, m.
    /// The momentum along z is zero in 2-D.
    template <int dim>
    Sums
    whole_point(const Points<dim> &points,
                const double       half_height,
                const unsigned int p)
    {
      const double y    = points.data(points.position, 1)[p];
      const double mass = points.data(points.mass)[p];
      const double v_z =
        (dim == 3 ? points.data(points.velocity, dim - 1)[p] : 0.);
      return {y - half_height,
              y + half_height,
              volume_of_points<dim, double>(points, p),
              mass,
              mass * points.data(points.velocity, 0)[p],
              mass * v_z};
    }



    /// Columns under a box along an axis, and the fraction of the box in each
    /// column.
    struct Shares
    {
      int                 first;
      std::vector<double> share;
    };

    /// Distribute a box over columns along axis @p d. The shares add up to 1,
    /// so volume and mass of the profile equal volume and mass of the soil.
    /// coordinate() is limited to the mesh, so the first and the last share
    /// include the parts outside the mesh.
    ///
    /// @param d axis
    /// @param lattice of the columns
    /// @param centre coordinate of the centre of the box, m
    /// @param length of the box, m
    template <int dim>
    Shares
    shares_along(const unsigned int      d,
                 const CellLattice<dim> &lattice,
                 const double            centre,
                 const double            length)
    {
      const double lower = centre - 0.5 * length, upper = centre + 0.5 * length;
      const int    last = lattice.coordinate(upper, d);
      Shares       result{lattice.coordinate(lower, d), {}};
      double       from = lower;
      for (int i = result.first; i < last; ++i)
        {
          const double to = lattice.lower_face(i + 1, d);
          result.share.push_back((to - from) / length);
          from = to;
        }
      // A box that ends at a face between columns has no part behind the face.
      if (upper > from || result.share.empty())
        result.share.push_back(length > 0 ? (upper - from) / length : 1.);
      return result;
    }



    /// Add the shares of point @p p to @p columns. Shares of boxes are used,
    /// not centres: the distance of points is a fraction of a cell, and the
    /// thickness of a column would jump by whole points whenever a centre
    /// crosses a face.
    template <int dim>
    void
    add_point(const State<dim>       &state,
              const CellLattice<dim> &lattice,
              const unsigned int      p,
              Columns                &columns)
    {
      const Points<dim> &points  = state.points;
      const auto         lengths = box_lengths(state, p);
      const Sums         whole   = whole_point(points, 0.5 * lengths[1], p);
      const auto         along   = [&](const unsigned int d) {
        return shares_along(d,
                            lattice,
                            points.data(points.position, d)[p],
                            lengths[d]);
      };
      const Shares x = along(0);
      // In 2-D there is a single slab.
      const Shares z = (dim == 3 ? along(dim - 1) : Shares{0, {1.}});

      typename CellLattice<dim>::Place place = {};
      for (unsigned int i = 0; i < x.share.size(); ++i)
        for (unsigned int k = 0; k < z.share.size(); ++k)
          {
            // In 2-D the first line sets y, and the second line overwrites y.
            place[dim - 1] = z.first + k;
            place[1]       = 0;
            place[0]       = x.first + i;
            // By round-off a share may be zero, and the column without mass.
            if (const double share = x.share[i] * z.share[k]; share > 0)
              columns[lattice.column(lattice.key(place))].add(whole, share);
          }
    }



    /// Sum the columns of all ranks on the first rank; a column may have soil
    /// of several ranks. The order of summation is the order of ranks, so the
    /// result is the same in each run. Collective.
    template <int dim>
    Columns
    sum_columns(const State<dim> &state)
    {
      const Grid<dim>       &grid = state.grid;
      const CellLattice<dim> lattice(grid);
      Columns                columns;
      for (unsigned int p = 0; p < state.points.size(); ++p)
        add_point(state, lattice, p, columns);

      Columns all;
      for (const Columns &part :
           Utilities::MPI::gather(grid.communicator(), columns))
        for (const auto &[column, sums] : part)
          all[column].add(sums);
      return all;
    }
  } // namespace



  template <int dim>
  std::vector<ProfileColumn>
  find_profile(const State<dim> &state, const Ground<dim> &ground)
  {
    using Lattice = CellLattice<dim>;
    const Lattice              lattice(state.grid);
    std::vector<ProfileColumn> profile;
    for (const auto &[column, sums] : sum_columns(state))
      {
        const typename Lattice::Key cell = Lattice::lowest_cell(column);
        Point<dim>                  foot;
        foot[dim - 1] = lattice.center(cell, dim - 1); // z, in 3-D
        foot[1]       = sums.lowest;
        foot[0]       = lattice.center(cell, 0);
        profile.push_back({foot[0],
                           dim == 3 ? foot[dim - 1] : 0.,
                           ground.elevation(foot),
                           sums.lowest,
                           sums.highest,
                           sums.volume / std::pow(lattice.size(), dim - 1),
                           sums.mass,
                           sums.momentum_x / sums.mass,
                           sums.momentum_z / sums.mass});
      }
    return profile;
  }



  /// In 3-D z follows x, as in observe(). The ground is a column only if it
  /// differs from the bottom face of the mesh.
  template <int dim>
  std::vector<std::string>
  Profile<dim>::columns(const OutputSettings & /*settings*/,
                        const State<dim> &state) const
  {
    std::vector<std::string> result = {"time [s]",
                                       "x [m]",
                                       "lowest [m]",
                                       "highest [m]",
                                       "thickness [m]",
                                       "depth-mean velocity [m/s]"};
    if (dim == 3)
      {
        result.insert(result.begin() + 2, "z [m]");
        result.push_back("depth-mean velocity z [m/s]");
      }
    if (!Ground<dim>(state.grid.domain(), obstacles_).is_bottom_face())
      result.push_back("ground [m]");
    return result;
  }



  template <int dim>
  void
  Profile<dim>::observe(const State<dim> &state)
  {
    std::vector<std::vector<double>> rows;
    const Ground<dim>                ground(state.grid.domain(), obstacles_);
    for (const ProfileColumn &column : find_profile(state, ground))
      {
        std::vector<double> row = {state.time,
                                   column.x,
                                   column.lowest,
                                   column.highest,
                                   column.thickness,
                                   column.velocity_x};
        if (dim == 3)
          {
            row.insert(row.begin() + 2, column.z);
            row.push_back(column.velocity_z);
          }
        if (!ground.is_bottom_face())
          row.push_back(column.ground);
        rows.push_back(row);
      }
    this->add_rows(state, rows);
  }



  template decltype(find_profile<2>) find_profile<2>;
  template decltype(find_profile<3>) find_profile<3>;
  template class Profile<2>;
  template class Profile<3>;
} // namespace talus

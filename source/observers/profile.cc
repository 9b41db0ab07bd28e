#include <talus/observers/cell_lattice.h>
#include <talus/observers/profile.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// What is summed up for a column.
    struct Sums
    {
      std::uint64_t column;
      double        lowest, highest; // m
      double        mass;            // kg
      double        momentum_x, momentum_z;

      void
      add(const Sums &more)
      {
        lowest  = std::min(lowest, more.lowest);
        highest = std::max(highest, more.highest);
        mass += more.mass;
        momentum_x += more.momentum_x;
        momentum_z += more.momentum_z;
      }

      /// For the message between ranks.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &column &lowest &highest &mass &momentum_x &momentum_z;
      }
    };



    /// Sort by column and add up what belongs together; in this order the sums
    /// do not depend on how the list came about.
    void
    merge(std::vector<Sums> &columns)
    {
      std::stable_sort(columns.begin(),
                       columns.end(),
                       [](const Sums &a, const Sums &b) {
                         return a.column < b.column;
                       });
      std::size_t n = 0;
      for (const Sums &sums : columns)
        if (n > 0 && columns[n - 1].column == sums.column)
          columns[n - 1].add(sums);
        else
          columns[n++] = sums;
      columns.resize(n);
    }



    template <int dim>
    Sums
    contribution(const Snapshot<dim>    &snapshot,
                 const CellLattice<dim> &lattice,
                 const unsigned int      p)
    {
      const Points<dim> &points      = snapshot.points;
      const double       y           = points.data(points.position, 1)[p];
      const double       half_length = 0.5 * box_lengths(snapshot, p)[1];
      const double       mass        = points.data(points.mass)[p];
      const double       v_z =
        (dim == 3 ? points.data(points.velocity, dim - 1)[p] : 0.);
      return {lattice.column(lattice.find(points, p)),
              y - half_length,
              y + half_length,
              mass,
              mass * points.data(points.velocity, 0)[p],
              mass * v_z};
    }



    template <int dim>
    std::vector<Sums>
    sum_columns(const Snapshot<dim> &snapshot)
    {
      const Grid<dim>       &grid = snapshot.grid;
      const CellLattice<dim> lattice(grid);
      std::vector<Sums>      columns;
      for (unsigned int p = 0; p < snapshot.points.size(); ++p)
        {
          const Sums more = contribution(snapshot, lattice, p);
          if (!columns.empty() && columns.back().column == more.column)
            columns.back().add(more);
          else
            columns.push_back(more);
        }
      merge(columns);
      if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
        return columns;

      std::vector<Sums> all;
      for (const auto &part :
           Utilities::MPI::gather(grid.communicator(), columns))
        all.insert(all.end(), part.begin(), part.end());
      merge(all);
      return all;
    }
  } // namespace



  template <int dim>
  std::vector<ProfileColumn>
  find_profile(const Snapshot<dim> &snapshot)
  {
    using Lattice = CellLattice<dim>;
    const Lattice              lattice(snapshot.grid);
    std::vector<ProfileColumn> profile;
    for (const Sums &sums : sum_columns(snapshot))
      {
        const typename Lattice::Key cell = Lattice::lowest_cell(sums.column);
        profile.push_back({lattice.center(cell, 0),
                           dim == 3 ? lattice.center(cell, dim - 1) : 0.,
                           sums.lowest,
                           sums.highest,
                           sums.mass,
                           sums.momentum_x / sums.mass,
                           sums.momentum_z / sums.mass});
      }
    return profile;
  }



  template <int dim>
  std::vector<std::string>
  Profile<dim>::names()
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
    return result;
  }



  template <int dim>
  void
  Profile<dim>::begin(const std::filesystem::path &folder,
                      const Grid<dim>             &grid,
                      const Beginning              beginning)
  {
    if (Utilities::MPI::this_mpi_process(grid.communicator()) == 0)
      file_.open(folder / file_name, names(), beginning);
  }



  template <int dim>
  void
  Profile<dim>::add_rows(const Snapshot<dim> &snapshot)
  {
    const auto profile = find_profile(snapshot);
    if (Utilities::MPI::this_mpi_process(snapshot.grid.communicator()) != 0)
      return;
    for (const ProfileColumn &column : profile)
      {
        std::vector<double> row = {snapshot.time,
                                   column.x,
                                   column.lowest,
                                   column.highest,
                                   column.highest - column.lowest,
                                   column.velocity_x};
        if (dim == 3)
          {
            row.insert(row.begin() + 2, column.z);
            row.push_back(column.velocity_z);
          }
        file_.add_row(row);
      }
    file_.flush();
  }



  template std::vector<ProfileColumn>
  find_profile(const Snapshot<2> &);
  template std::vector<ProfileColumn>
  find_profile(const Snapshot<3> &);
  template class Profile<2>;
  template class Profile<3>;
} // namespace talus

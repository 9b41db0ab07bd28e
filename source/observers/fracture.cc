// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/cell_lattice.h>
#include <talus/observers/fracture.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// An occupied cell and the number of points in it.
    struct Occupied
    {
      std::uint64_t key;
      unsigned long n_points;

      /// Serialize for MPI messages.
      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &key &n_points;
      }
    };



    /// Sort the cells and combine entries with equal keys.
    void
    merge(std::vector<Occupied> &cells)
    {
      std::sort(cells.begin(),
                cells.end(),
                [](const Occupied &a, const Occupied &b) {
                  return a.key < b.key;
                });
      std::size_t n = 0;
      for (const Occupied &cell : cells)
        if (n > 0 && cells[n - 1].key == cell.key)
          cells[n - 1].n_points += cell.n_points;
        else
          cells[n++] = cell;
      cells.resize(n);
    }



    /// Collect the occupied cells of all ranks, sorted, on the first rank
    /// (empty on the other ranks). The cost grows with the number of points,
    /// not with the number of cells of the mesh. Several ranks may have points
    /// in a cell, for example where the mesh is finer than the lattice, so the
    /// lists are merged. Collective.
    template <int dim>
    std::vector<Occupied>
    find_occupied(const Points<dim> &points, const Grid<dim> &grid)
    {
      const CellLattice<dim> lattice(grid);
      std::vector<Occupied>  cells;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          // Points are nearly always sorted by cell, and consecutive points are
          // mostly in the same cell: merging equal neighbours keeps the list
          // to sort short.
          const std::uint64_t key = lattice.find(points, p);
          if (!cells.empty() && cells.back().key == key)
            ++cells.back().n_points;
          else
            cells.push_back({key, 1});
        }
      merge(cells);
      if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
        return cells;

      std::vector<Occupied> all;
      for (const auto &part :
           Utilities::MPI::gather(grid.communicator(), cells))
        all.insert(all.end(), part.begin(), part.end());
      merge(all);
      return all;
    }



    /// Differences between the key of a cell and the keys of all neighbours
    /// with smaller keys, across faces, edges and corners.
    template <int dim>
    std::vector<std::uint64_t>
    steps_to_earlier_neighbors()
    {
      using Lattice = CellLattice<dim>;
      typename Lattice::Place center, neighbor;
      center.fill(1);
      std::vector<std::uint64_t> steps;
      for (unsigned int k = 0; k < power(3, dim); ++k)
        {
          for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 3)
            neighbor[d] = rest % 3;
          if (Lattice::key(neighbor) < Lattice::key(center))
            steps.push_back(Lattice::key(center) - Lattice::key(neighbor));
        }
      return steps;
    }



    /// For each cell the index of the first cell of its connected group, by
    /// union-find. The cells are sorted, so a single walk along the list finds
    /// all neighbours in a given direction.
    template <int dim>
    std::vector<std::size_t>
    find_bodies(const std::vector<Occupied> &cells)
    {
      std::vector<std::size_t> parent(cells.size());
      std::iota(parent.begin(), parent.end(), std::size_t(0));
      const auto root = [&](std::size_t i) {
        // Each look-up halves the path, which keeps the trees flat.
        while (parent[i] != i)
          i = parent[i] = parent[parent[i]];
        return i;
      };

      for (const std::uint64_t step : steps_to_earlier_neighbors<dim>())
        for (std::size_t i = 0, j = 0; i < cells.size(); ++i)
          {
            while (cells[j].key + step < cells[i].key)
              ++j;
            if (cells[j].key + step != cells[i].key)
              continue;
            const std::size_t a = root(i), b = root(j);
            // The root is the first cell of the group, so that results do not
            // depend on the order of the directions.
            parent[std::max(a, b)] = std::min(a, b);
          }
      for (std::size_t i = 0; i < cells.size(); ++i)
        parent[i] = root(i);
      return parent;
    }



    /// Return whether the centre of a cell is outside of all obstacles.
    template <int dim>
    bool
    is_open(const CellLattice<dim> &lattice,
            const Ground<dim>      &ground,
            const std::uint64_t     key)
    {
      Point<dim> centre;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] = lattice.center(key, d);
      return ground.is_open(centre);
    }



    /// For each cell, whether the connected group has a cell on the ground: at
    /// the bottom of the mesh, or above a cell inside an obstacle. Soil on the
    /// ground must fill the cells below; hanging or falling soil need not.
    template <int dim>
    std::vector<bool>
    rests_on_ground(const std::vector<Occupied>    &cells,
                    const std::vector<std::size_t> &body,
                    const CellLattice<dim>         &lattice,
                    const Ground<dim>              &ground)
    {
      const auto lies_on_ground = [&](const std::size_t i) {
        if (CellLattice<dim>::place(cells[i].key)[1] == 0)
          return true;
        // Keys of a column increase upwards by 1.
        const std::uint64_t below = cells[i].key - 1;
        return !ground.is_bottom_face() &&
               !(i > 0 && cells[i - 1].key == below) &&
               !is_open(lattice, ground, below);
      };
      std::vector<bool> result(cells.size(), false);
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (lies_on_ground(i))
          result[body[i]] = true;
      for (std::size_t i = 0; i < cells.size(); ++i)
        result[i] = result[body[i]];
      return result;
    }



    /// Number of unoccupied cells below the occupied cell @p key, down to the
    /// cell with index @p end, exclusive, or to the ground. Cells below a
    /// closed cell, as under a pipe, are not between the soil and the ground.
    ///
    /// @param key of the occupied cell
    /// @param end y index of the next occupied cell below; -1 for the mesh
    ///   bottom
    /// @param is_occupied_at_end whether the cell at @p end is occupied
    /// @param rests whether the soil rests on the ground
    /// @param lattice of the cells
    /// @param ground under the soil
    template <int dim>
    unsigned long
    n_empty_below(const std::uint64_t     key,
                  const int               end,
                  const bool              is_occupied_at_end,
                  const bool              rests,
                  const CellLattice<dim> &lattice,
                  const Ground<dim>      &ground)
    {
      const int n = CellLattice<dim>::place(key)[1] - end - 1;
      if (!is_occupied_at_end && !rests)
        return 0;
      if (!ground.is_bottom_face())
        for (int i = 1; i <= n; ++i)
          if (!is_open(lattice, ground, key - i))
            return rests ? i - 1 : 0;
      return n;
    }
  } // namespace



  /// Keys sort by x, then z, then y, so a single pass over the occupied cells
  /// suffices: between consecutive cells of the list there are either empty
  /// cells of a column, or empty columns. No memory is used for unoccupied
  /// cells, the majority of the mesh.
  template <int dim>
  FractureCounts
  count_fractures(const Points<dim> &points,
                  const Grid<dim>   &grid,
                  const Ground<dim> &ground)
  {
    using Lattice = CellLattice<dim>;
    const Lattice                  lattice(grid);
    const std::vector<Occupied>    cells = find_occupied(points, grid);
    const std::vector<std::size_t> body  = find_bodies<dim>(cells);
    const std::vector<bool>        rests =
      rests_on_ground(cells, body, lattice, ground);
    FractureCounts counts;
    counts.occupied_cells = cells.size();

    for (std::size_t i = 0; i < cells.size(); ++i)
      {
        counts.connected_bodies += (body[i] == i);
        counts.cells_with_one_point += (cells[i].n_points == 1);

        const auto place     = Lattice::place(cells[i].key);
        const bool is_lowest = (i == 0 || Lattice::column(cells[i - 1].key) !=
                                            Lattice::column(cells[i].key));
        counts.empty_interior_cells +=
          n_empty_below(cells[i].key,
                        is_lowest ? -1 : Lattice::place(cells[i - 1].key)[1],
                        !is_lowest,
                        rests[i],
                        lattice,
                        ground);

        // In 3-D the cells with equal x form a slab, within which the
        // difference is not positive.
        const int left =
          (i == 0 ? place[0] : Lattice::place(cells[i - 1].key)[0]);
        counts.empty_columns += std::max(place[0] - left - 1, 0);
      }
    return counts;
  }



  /// Numbers of cells have no unit.
  template <int dim>
  void
  list_fractures(const State<dim>  &state,
                 const Ground<dim> &ground,
                 Quantities        &list)
  {
    const FractureCounts counts =
      count_fractures(state.points, state.grid, ground);
    const auto add = [&list](const std::string &name, const double value) {
      list.push_back({name, "", value});
    };
    add("empty interior cells", counts.empty_interior_cells);
    add("empty columns", counts.empty_columns);
    add("connected bodies", counts.connected_bodies);
    add("cells with one point", counts.cells_with_one_point);
  }



  template decltype(count_fractures<2>) count_fractures<2>;
  template decltype(count_fractures<3>) count_fractures<3>;
  template decltype(list_fractures<2>)  list_fractures<2>;
  template decltype(list_fractures<3>)  list_fractures<3>;
} // namespace talus

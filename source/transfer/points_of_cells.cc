// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/transfer/points_of_cells.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  // The data of a cell are its points, column by column, and the weight behind
  // them. All ranks have the same columns. Points of cells that stay on their
  // rank are packed, too: repartitions are rare, and the indices of all cells
  // change.
  template <int dim>
  unsigned int
  attach_points(Grid<dim>                 &grid,
                const Points<dim>         &points,
                const std::vector<double> &weights)
  {
    std::vector<unsigned int> end(grid.n_owned_cells(), 0);
    for (const Segment &segment : points.segments())
      end[segment.cell] = segment.end;
    for (unsigned int c = 1; c < end.size(); ++c)
      end[c] = std::max(end[c], end[c - 1]);
    // deal.II calls the function later.
    return grid.triangulation().register_data_attach(
      [&grid, &points, &weights, end](const auto &cell, const auto) {
        const unsigned int  c     = grid.index_of(cell);
        const unsigned int  begin = (c == 0 ? 0 : end[c - 1]);
        std::vector<double> values;
        for (unsigned int a = 0; a < points.n_arrays(); ++a)
          values.insert(values.end(),
                        points.data(a) + begin,
                        points.data(a) + end[c]);
        values.push_back(weights[c]);
        const auto *bytes = reinterpret_cast<const char *>(values.data());
        return std::vector<char>(bytes, bytes + values.size() * sizeof(double));
      },
      /*returns_variable_size_data=*/true);
  }



  // A file that a rank could not write completely, on a disk that was full for
  // a moment, lacks the weight of the last cell of the rank.
  template <int dim>
  std::vector<unsigned int>
  points_of_cells(Grid<dim>           &grid,
                  const unsigned int   handle,
                  Points<dim>         &points,
                  std::vector<double> &weights)
  {
    const unsigned int n_arrays = points.n_arrays();
    points.clear();
    weights.assign(grid.n_owned_cells(), 0.);
    std::vector<unsigned int> cells;
    grid.triangulation().notify_ready_to_unpack(
      handle, [&](const auto &cell, const auto, const auto &range) {
        const unsigned int c = grid.index_of(cell);
        const std::size_t  n_values =
          (range.end() - range.begin()) / sizeof(double);
        if (n_values == 0)
          return;
        std::vector<double> values(n_values);
        std::copy(range.begin(),
                  range.end(),
                  reinterpret_cast<char *>(values.data()));
        weights[c]               = values.back();
        const unsigned int n     = (n_values - 1) / n_arrays;
        const unsigned int begin = points.append(n);
        cells.resize(begin + n, c);
        for (unsigned int a = 0; a < n_arrays; ++a)
          std::copy_n(values.begin() + a * n, n, points.data(a) + begin);
      });
    AssertThrow(std::all_of(weights.begin(),
                            weights.end(),
                            [](const double weight) { return weight >= 1.; }),
                ExcUser("The points of the checkpoint are not complete. Remove "
                        "the checkpoint, so that the previous one is used."));
    return cells;
  }



  template decltype(attach_points<2>)   attach_points<2>;
  template decltype(attach_points<3>)   attach_points<3>;
  template decltype(points_of_cells<2>) points_of_cells<2>;
  template decltype(points_of_cells<3>) points_of_cells<3>;
} // namespace talus

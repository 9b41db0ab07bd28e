// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle_sizes.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Number of cells across an obstacle that resolves the obstacle: with four,
    // the force on a pipe is right within a few per cent.
    constexpr double n_cells_needed = 4.;

    /// Extent of an obstacle along a direction, m.
    struct Extent
    {
      double      length;
      std::string direction;
    };



    /// Return the extents of an obstacle, the shortest first: the lengths of
    /// the bounding box along the axes and, of an obstacle that may be oblique,
    /// the width across, dim - 1 times.
    template <int dim>
    std::vector<Extent>
    sorted_extents(const Obstacle<dim> &obstacle)
    {
      const Box<dim>      box = obstacle.bounding_box();
      std::vector<Extent> extents;
      for (unsigned int d = 0; d < dim; ++d)
        extents.push_back({box.length(d), std::string(" along ") + "xyz"[d]});
      if (const double width = obstacle.shape().width(); std::isfinite(width))
        for (unsigned int d = 1; d < dim; ++d)
          extents.push_back({width, " across"});
      std::stable_sort(extents.begin(),
                       extents.end(),
                       [](const Extent &a, const Extent &b) {
                         return a.length < b.length;
                       });
      return extents;
    }



    /// Text for @p length, m, with three digits and unit.
    std::string
    in_words(const double length)
    {
      return text(std::setprecision(3), length, " m");
    }



    std::string
    in_words(const Extent &extent)
    {
      return in_words(extent.length) + extent.direction;
    }



    const std::string how_to_refine =
      "by 'Grid/Cell size', or by 'Grid/Refinement boxes' around the obstacle";
  } // namespace



  template <int dim>
  std::vector<Remark>
  check_obstacle_sizes(const Obstacles<dim> &obstacles, const Grid<dim> &grid)
  {
    std::vector<Remark> notes;
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        const Box<dim> box     = obstacles[k].bounding_box();
        const double   h       = grid.finest_size_in(box);
        const auto     extents = sorted_extents(obstacles[k]);
        // Tolerance for round-off in the size of a cell that fits exactly.
        const auto is_shorter = [](const double a, const double b) {
          return a < (1. - 1e-9) * b;
        };
        const std::string needed = in_words(extents[0].length / n_cells_needed);
        AssertThrow(!is_shorter(extents[1].length, h),
                    ExcUser(text("The obstacle '",
                                 obstacles[k].name(),
                                 "' is only ",
                                 in_words(extents[0]),
                                 " and ",
                                 in_words(extents[1]),
                                 ", less than a cell of ",
                                 in_words(h),
                                 " along two axes: the soil would meet a body "
                                 "as large as a cell. Use cells of ",
                                 needed,
                                 " or less there, ",
                                 how_to_refine,
                                 ", or remove the obstacle.")));
        if (is_shorter(extents[0].length, 2. * h))
          notes.emplace_back(text("only ",
                                  in_words(extents[0]),
                                  ", less than two cells of ",
                                  in_words(h),
                                  ": soil on both sides moves with the same "
                                  "nodes, and the force on the obstacle is "
                                  "inaccurate. Use cells of ",
                                  needed,
                                  " or less there, ",
                                  how_to_refine,
                                  "."),
                             Severity::look,
                             "obstacle '" + obstacles[k].name() + "'");
      }
    return notes;
  }



  template decltype(check_obstacle_sizes<2>) check_obstacle_sizes<2>;
  template decltype(check_obstacle_sizes<3>) check_obstacle_sizes<3>;
} // namespace talus

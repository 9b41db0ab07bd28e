// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle_remarks.h>

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



  namespace
  {
    // No interface of soil has this coefficient of friction: a larger one is
    // given to let the soil shear above the surface.
    constexpr double rough = 2.;



    template <int dim>
    std::string
    subject(const Obstacle<dim> &obstacle)
    {
      return "obstacle '" + obstacle.name() + "'";
    }



    template <int dim>
    bool
    has_end(const Box<dim> &box)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::isinf(box.lower[d]) || std::isinf(box.upper[d]))
          return false;
      return true;
    }



    template <int dim>
    bool
    is_in_another(const Obstacles<dim> &obstacles,
                  const unsigned int    k,
                  const Point<dim>     &x)
    {
      for (const unsigned int other : obstacles.near(x, 0.))
        if (other != k && obstacles[other].shape().contains(x))
          return true;
      return false;
    }



    /// Whether a part of obstacle @p k can be met in @p domain, from samples in
    /// and near the obstacle: a wall may be thinner than the sample distance.
    template <int dim>
    bool
    is_met(const Obstacles<dim> &obstacles,
           const unsigned int    k,
           const Box<dim>       &domain)
    {
      constexpr unsigned int n   = (dim == 2 ? 32 : 16); // along an axis
      Box<dim>               box = obstacles[k].shape().bounding_box();
      for (unsigned int d = 0; d < dim; ++d)
        {
          box.lower[d] = std::max(box.lower[d], domain.lower[d]);
          box.upper[d] = std::min(box.upper[d], domain.upper[d]);
          if (box.lower[d] >= box.upper[d])
            return false;
        }
      Tensor<1, dim> step;
      for (unsigned int d = 0; d < dim; ++d)
        step[d] = box.length(d) / n;
      for (unsigned int i = 0; i < std::pow(n + 1, dim); ++i)
        {
          Point<dim> x = box.lower;
          for (unsigned int d = 0, rest = i; d < dim; rest /= n + 1, ++d)
            x[d] += rest % (n + 1) * step[d];
          if (obstacles[k].shape().signed_distance(x) <= 0.5 * step.norm() &&
              !is_in_another(obstacles, k, x))
            return true;
        }
      return false;
    }
  } // namespace



  template <int dim>
  std::vector<Remark>
  notes_on_hidden_obstacles(const Obstacles<dim> &obstacles,
                            const Box<dim>       &domain)
  {
    std::vector<Remark> notes;
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      if (!obstacles[k].moves() &&
          has_end(obstacles[k].shape().bounding_box()) &&
          !is_met(obstacles, k, domain))
        notes.emplace_back("no part lies in the mesh outside of the other "
                           "obstacles: soil never meets this obstacle, and all "
                           "forces on the obstacle are 0. Move the obstacle, "
                           "or remove the name from 'Obstacles/Names'.",
                           Severity::wrong,
                           subject(obstacles[k]));
    return notes;
  }



  template <int dim>
  std::vector<Remark>
  notes_on_uncapped_beds(const Obstacles<dim> &obstacles)
  {
    std::vector<Remark> notes;
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      if (const double mu = obstacles[k].bed().coefficient();
          mu > 0. && !obstacles[k].bed().limits_shear_stress() &&
          !has_end(obstacles[k].shape().bounding_box()))
        notes.emplace_back(
          text("there is no 'Maximum shear stress', but the soil has an "
               "undrained shear strength: the surface passes up to ",
               mu,
               " times the normal stress, which may be far above the strength, "
               "so that the soil shears above the surface instead of sliding. "
               "To let the soil slide, give the shear strength of the "
               "interface by 'Maximum shear stress'."),
          mu < rough ? Severity::look : Severity::information,
          subject(obstacles[k]));
    return notes;
  }



  template decltype(notes_on_hidden_obstacles<2>) notes_on_hidden_obstacles<2>;
  template decltype(notes_on_hidden_obstacles<3>) notes_on_hidden_obstacles<3>;
  template decltype(notes_on_uncapped_beds<2>)    notes_on_uncapped_beds<2>;
  template decltype(notes_on_uncapped_beds<3>)    notes_on_uncapped_beds<3>;
} // namespace talus

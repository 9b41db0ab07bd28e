// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/obstacle_remarks.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/problem/mudline.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  bool
  Mudline<dim>::is_soil(const Point<dim> &x) const
  {
    return std::any_of(bodies_.begin(), bodies_.end(), [&x](const auto &body) {
      return body->contains(x);
    });
  }



  /// Return a height free of soil below @p x, m: the radius of the largest ball
  /// around x, by halving @p radius, that no surface cuts.
  template <int dim>
  double
  Mudline<dim>::clear_height(const Point<dim> &x, double radius) const
  {
    for (const auto &body : bodies_)
      while (radius > 1e-4 * domain_.length(1) && body->may_cut_ball(x, radius))
        radius *= 0.5;
    return radius;
  }



  /// Return the height of the uppermost soil above @p bottom in the vertical
  /// through @p x, m; none without soil. The search descends in steps that
  /// cannot pass the surface, or of a ten-thousandth of the mesh, and ends by
  /// bisection. A step is at most twice as high as the step before.
  template <int dim>
  std::optional<double>
  Mudline<dim>::highest_soil(const Point<dim> &x, const double bottom) const
  {
    Point<dim> above = x, below = x;
    above[1] = std::max(domain_.upper[1], bottom);
    if (is_soil(above))
      return above[1];
    double height = domain_.length(1);
    for (below = above; !is_soil(below) && below[1] > bottom;)
      {
        above  = below;
        height = clear_height(below, std::min(2. * height, domain_.length(1)));
        below[1] = std::max(bottom, below[1] - height);
      }
    if (!is_soil(below))
      return {};
    while (above[1] - below[1] > 1e-12 * domain_.length(1))
      {
        Point<dim> middle                 = above;
        middle[1]                         = 0.5 * (above[1] + below[1]);
        (is_soil(middle) ? below : above) = middle;
      }
    return below[1];
  }



  /// Round-off may place x itself outside of the soil: the depth is then 0.
  template <int dim>
  double
  Mudline<dim>::depth(const Point<dim> &x) const
  {
    return highest_soil(x, x[1]).value_or(x[1]) - x[1];
  }



  template <int dim>
  double
  Mudline<dim>::height(const Point<dim> &x) const
  {
    return highest_soil(x, domain_.lower[1])
      .value_or(std::numeric_limits<double>::quiet_NaN());
  }



  template <int dim>
  Mudline<dim>
  mudline_of(const std::vector<std::unique_ptr<Body<dim>>> &bodies,
             const Box<dim>                                &domain)
  {
    typename Mudline<dim>::Bodies shapes;
    for (const auto &body : bodies)
      shapes.push_back(body->shape(domain));
    return Mudline<dim>(std::move(shapes), domain);
  }



  template class Mudline<2>;
  template class Mudline<3>;
  template decltype(mudline_of<2>) mudline_of<2>;
  template decltype(mudline_of<3>) mudline_of<3>;
} // namespace talus

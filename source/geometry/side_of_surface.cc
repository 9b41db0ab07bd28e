// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/side_of_surface.h>

#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  std::pair<double, Tensor<1, dim>>
  SideOfSurface<dim>::distance_and_normal(const Point<dim> &x) const
  {
    const auto     b = surface_->at(x);
    Tensor<1, dim> n = -b.slope;
    n[1]             = 1.;
    n *= sign_ / n.norm();
    return {n[1] * (x[1] - b.height), n};
  }



  template <int dim>
  double
  SideOfSurface<dim>::signed_distance(const Point<dim> &x) const
  {
    return distance_and_normal(x).first;
  }



  template <int dim>
  Tensor<1, dim>
  SideOfSurface<dim>::normal(const Point<dim> &x) const
  {
    return distance_and_normal(x).second;
  }



  template <int dim>
  bool
  SideOfSurface<dim>::contains(const Point<dim> &x) const
  {
    return sign_ * (x[1] - surface_->height(x)) <= 0.;
  }



  template <int dim>
  Box<dim>
  SideOfSurface<dim>::bounding_box() const
  {
    Box<dim> box;
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.upper[d] = std::numeric_limits<double>::infinity();
        box.lower[d] = -box.upper[d];
      }
    return box;
  }



  /// The tangent plane at x does not show a steep slope beside x.
  template <int dim>
  bool
  SideOfSurface<dim>::may_cut_ball(const Point<dim> &x,
                                   const double      radius) const
  {
    const double height = std::abs(x[1] - surface_->at(x).height);
    return height < radius ||
           height < radius + surface_->largest_change(x, radius);
  }



  template <int dim>
  bool
  SideOfSurface<dim>::is_beyond(const Shape<dim> &other) const
  {
    const auto *side = dynamic_cast<const SideOfSurface *>(&other);
    return side != nullptr && side->surface_ == surface_ &&
           side->sign_ == -sign_;
  }



  template class SideOfSurface<2>;
  template class SideOfSurface<3>;
} // namespace talus

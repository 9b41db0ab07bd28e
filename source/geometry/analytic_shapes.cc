// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/analytic_shapes.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();
  } // namespace



  template <int dim>
  HalfSpace<dim>::HalfSpace(const Point<dim>     &point,
                            const Tensor<1, dim> &normal)
    : point_(point)
    , normal_(normal / normal.norm())
  {}



  template <int dim>
  double
  HalfSpace<dim>::signed_distance(const Point<dim> &x) const
  {
    return (x - point_) * normal_;
  }



  /// The box is finite along an axis only if the plane is perpendicular to the
  /// axis, and only on one side.
  template <int dim>
  Box<dim>
  HalfSpace<dim>::bounding_box() const
  {
    Box<dim> box;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const bool across = std::abs(normal_[d]) == 1.;
        box.lower[d]      = across && normal_[d] < 0. ? point_[d] : -infinity;
        box.upper[d]      = across && normal_[d] > 0. ? point_[d] : infinity;
      }
    return box;
  }



  /// Inside, the nearest face counts; outside, all faces with the place beyond
  /// them: the result is the distance to an edge or a corner.
  template <int dim>
  double
  BoxRegion<dim>::signed_distance(const Point<dim> &x) const
  {
    double inside = -infinity, outside = 0.;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double beyond =
          std::max(box_.lower[d] - x[d], x[d] - box_.upper[d]);
        inside = std::max(inside, beyond);
        outside += std::pow(std::max(beyond, 0.), 2);
      }
    return inside <= 0. ? inside : std::sqrt(outside);
  }



  template <int dim>
  Tensor<1, dim>
  BoxRegion<dim>::normal(const Point<dim> &x) const
  {
    double         inside = -infinity;
    Tensor<1, dim> of_nearest_face, outside;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double below = box_.lower[d] - x[d], above = x[d] - box_.upper[d];
        const double beyond = std::max(below, above);
        const double sign   = below > above ? -1. : 1.;
        outside[d]          = sign * std::max(beyond, 0.);
        if (beyond > inside)
          {
            inside             = beyond;
            of_nearest_face    = Tensor<1, dim>();
            of_nearest_face[d] = sign;
          }
      }
    return inside <= 0. ? of_nearest_face : outside / outside.norm();
  }



  template <int dim>
  double
  Ball<dim>::signed_distance(const Point<dim> &x) const
  {
    const double r = x.distance(centre_);
    return inner_radius_ > 0. ? std::max(r - radius_, inner_radius_ - r)
                              : r - radius_;
  }



  /// The surface of a hollow faces the centre. At the centre any direction is
  /// valid.
  template <int dim>
  Tensor<1, dim>
  Ball<dim>::normal(const Point<dim> &x) const
  {
    const Tensor<1, dim> radial = x - centre_;
    const double         r      = radial.norm();
    if (r == 0.)
      return Point<dim>::unit_vector(0);
    const bool faces_centre =
      inner_radius_ > 0. && inner_radius_ - r > r - radius_;
    return (faces_centre ? -1. : 1.) / r * radial;
  }



  template <int dim>
  Box<dim>
  Ball<dim>::bounding_box() const
  {
    Box<dim> box{centre_, centre_};
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.lower[d] -= radius_;
        box.upper[d] += radius_;
      }
    return box;
  }



  Prism::Prism(std::unique_ptr<const Shape<2>> base,
               const double                    lower,
               const double                    upper,
               const unsigned int              axis)
    : base_(std::move(base))
    , lower_(lower)
    , upper_(upper)
    , axis_(axis)
  {}



  Point<3>
  Prism::place(const double first,
               const double second,
               const double along) const
  {
    return axis_ == 2 ? Point<3>(first, second, along)
                      : Point<3>(first, along, second);
  }



  double
  Prism::distance_to_ends(const double along) const
  {
    return std::max(lower_ - along, along - upper_);
  }



  /// As in a box: the base and the ends are perpendicular to each other.
  double
  Prism::signed_distance(const Point<3> &x) const
  {
    const double across = base_->signed_distance(foot(x));
    const double along  = distance_to_ends(x[axis_]);
    return across > 0. && along > 0. ? std::hypot(across, along)
                                     : std::max(across, along);
  }



  Tensor<1, 3>
  Prism::normal(const Point<3> &x) const
  {
    const double       across = base_->signed_distance(foot(x));
    const double       along  = distance_to_ends(x[axis_]);
    const double       sign = lower_ - x[axis_] > x[axis_] - upper_ ? -1. : 1.;
    const Tensor<1, 2> n    = base_->normal(foot(x));
    const Tensor<1, 3> of_base = place(n[0], n[1], 0.),
                       of_end  = place(0., 0., sign);
    if (across > 0. && along > 0.)
      return (across * of_base + along * of_end) / std::hypot(across, along);
    return across >= along ? of_base : of_end;
  }



  bool
  Prism::contains(const Point<3> &x) const
  {
    return distance_to_ends(x[axis_]) <= 0. && base_->contains(foot(x));
  }



  Box<3>
  Prism::bounding_box() const
  {
    const Box<2> base = base_->bounding_box();
    return {place(base.lower[0], base.lower[1], lower_),
            place(base.upper[0], base.upper[1], upper_)};
  }



  Tensor<1, 3>
  perpendicular(const Tensor<1, 3> &direction)
  {
    unsigned int flattest = 0;
    for (unsigned int d = 1; d < 3; ++d)
      if (std::abs(direction[d]) < std::abs(direction[flattest]))
        flattest = d;
    const Tensor<1, 3> result =
      cross_product_3d(direction, Point<3>::unit_vector(flattest));
    return result / result.norm();
  }



  namespace
  {
    /// Return the corners of the section of a frustum: of a tube on one side of
    /// the axis, otherwise on both sides, so that the axis is no edge.
    std::vector<Point<2>>
    section_of_frustum(const double length,
                       const double radius,
                       const double end_radius,
                       const double inner_radius)
    {
      const bool is_tube = inner_radius > 0.;
      return {Point<2>(is_tube ? inner_radius : -radius, 0.),
              Point<2>(radius, 0.),
              Point<2>(end_radius, length),
              Point<2>(is_tube ? inner_radius : -end_radius, length)};
    }
  } // namespace



  // The surface nearest to a place lies in the half plane of the place and the
  // axis, so the distance is the distance from the section.
  Frustum::Frustum(const Point<3> &from,
                   const Point<3> &to,
                   const double    radius,
                   const double    end_radius,
                   const double    inner_radius)
    : from_(from)
    , to_(to)
    , along_((to - from) / to.distance(from))
    , radius_(radius)
    , end_radius_(end_radius)
    , profile_(
        "The section of the frustum",
        section_of_frustum(to.distance(from), radius, end_radius, inner_radius))
  {}



  Point<2>
  Frustum::in_profile(const Point<3> &x) const
  {
    const double s = (x - from_) * along_;
    return {(x - from_ - s * along_).norm(), s};
  }



  /// On the axis any direction across the axis is valid.
  Tensor<1, 3>
  Frustum::normal(const Point<3> &x) const
  {
    const Point<2>     place  = in_profile(x);
    const Tensor<1, 2> n      = profile_.normal(place);
    const Tensor<1, 3> across = x - from_ - place[1] * along_;
    return n[0] * (place[0] > 0. ? across / place[0] : perpendicular(along_)) +
           n[1] * along_;
  }



  /// A disc reaches along an axis as far as the sine of the angle to its own.
  Box<3>
  Frustum::bounding_box() const
  {
    Box<3> box;
    for (unsigned int d = 0; d < 3; ++d)
      {
        const double sine = std::sqrt(std::max(0., 1. - along_[d] * along_[d]));
        box.lower[d] =
          std::min(from_[d] - radius_ * sine, to_[d] - end_radius_ * sine);
        box.upper[d] =
          std::max(from_[d] + radius_ * sine, to_[d] + end_radius_ * sine);
      }
    return box;
  }



  template class HalfSpace<2>;
  template class HalfSpace<3>;
  template class BoxRegion<2>;
  template class BoxRegion<3>;
  template class Ball<2>;
  template class Ball<3>;
} // namespace talus

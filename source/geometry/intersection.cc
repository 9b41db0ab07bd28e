// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/intersection.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  double
  Intersection<dim>::signed_distance(const Point<dim> &x) const
  {
    double result = parts_[0]->signed_distance(x);
    for (std::size_t i = 1; i < parts_.size(); ++i)
      result = std::max(result, parts_[i]->signed_distance(x));
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  Intersection<dim>::normal(const Point<dim> &x) const
  {
    return (*std::max_element(parts_.begin(),
                              parts_.end(),
                              [&x](const auto &a, const auto &b) {
                                return a->signed_distance(x) <
                                       b->signed_distance(x);
                              }))
      ->normal(x);
  }



  template <int dim>
  Box<dim>
  Intersection<dim>::bounding_box() const
  {
    Box<dim> result = parts_[0]->bounding_box();
    for (const auto &part : parts_)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Box<dim> box = part->bounding_box();
          result.lower[d]    = std::max(result.lower[d], box.lower[d]);
          result.upper[d]    = std::min(result.upper[d], box.upper[d]);
        }
    return result;
  }



  /// Outside of a part, no further parts are evaluated: they may be undefined
  /// at @p x. Once a surface may cut the ball, only a part that leaves out the
  /// whole ball matters, and such a part does not contain @p x.
  template <int dim>
  bool
  Intersection<dim>::may_cut_ball(const Point<dim> &x,
                                  const double      radius) const
  {
    bool may_cut = false;
    for (const auto &part : parts_)
      {
        const bool is_outside = part->signed_distance(x) > 0.;
        if (may_cut && !is_outside)
          continue;
        if (part->may_cut_ball(x, radius))
          may_cut = true;
        else if (is_outside)
          return false;
      }
    return may_cut;
  }



  template <int dim>
  bool
  Intersection<dim>::contains(const Point<dim> &x) const
  {
    return std::all_of(parts_.begin(), parts_.end(), [&x](const auto &part) {
      return part->contains(x);
    });
  }



  template <int dim>
  std::vector<const Shape<dim> *>
  Intersection<dim>::parts() const
  {
    std::vector<const Shape<dim> *> result;
    for (const auto &part : parts_)
      result.push_back(part.get());
    return result;
  }



  template class Intersection<2>;
  template class Intersection<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/geometry/plan_on_map.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  PlanOnMap<dim>::PlanOnMap(const Point<3>              &origin,
                            const std::vector<Point<2>> &section)
    : origin_(origin)
    , section_(section)
    , lengths_(1, 0.)
  {
    TalusAssert(dim == 3 || section.size() >= 2,
                ExcMessage("A section needs two corners."));
    for (std::size_t i = 1; i < section_.size(); ++i)
      lengths_.push_back(lengths_.back() +
                         section_[i].distance(section_[i - 1]));
  }



  template <>
  PlanOnMap<3>::Place
  PlanOnMap<3>::at(const Point<3> &x) const
  {
    Place place;
    place.x       = Point<2>(x[0], -x[2]);
    place.origin  = Point<2>(origin_[0], origin_[1]);
    place.axes[0] = Point<2>(1., 0.);
    place.axes[2] = Point<2>(0., -1.);
    return place;
  }



  template <>
  PlanOnMap<2>::Place
  PlanOnMap<2>::at(const Point<2> &x) const
  {
    // Leg of the line at x; the first and the last leg are endless.
    const auto beyond =
      std::upper_bound(lengths_.begin() + 1, lengths_.end() - 1, x[0]);
    const std::size_t  i   = beyond - lengths_.begin();
    const Tensor<1, 2> leg = section_[i] - section_[i - 1];
    Place              place;
    place.axes[0] = leg / leg.norm();
    place.x       = Point<2>((x[0] - lengths_[i - 1]) * place.axes[0]);
    place.origin  = section_[i - 1];
    return place;
  }



  template class PlanOnMap<2>;
  template class PlanOnMap<3>;
} // namespace talus

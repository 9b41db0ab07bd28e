// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/errors.h>
#include <talus/geometry/terrain.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Terrain<dim>::Terrain(std::shared_ptr<const HeightField> heights,
                        const std::string                 &name,
                        const Point<3>                    &origin,
                        const std::vector<Point<2>>       &section)
    : heights_(std::move(heights))
    , name_(name)
    , origin_(origin)
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
  Terrain<3>::Place
  Terrain<3>::place_on_map(const Point<3> &x) const
  {
    Place place;
    place.x       = Point<2>(x[0], -x[2]);
    place.origin  = Point<2>(origin_[0], origin_[1]);
    place.axes[0] = Point<2>(1., 0.);
    place.axes[2] = Point<2>(0., -1.);
    return place;
  }



  template <>
  Terrain<2>::Place
  Terrain<2>::place_on_map(const Point<2> &x) const
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



  template <int dim>
  bool
  Terrain<dim>::is_known_at(const Point<dim> &x) const
  {
    const Place place = place_on_map(x);
    return heights_->at(place.x, place.origin).has_value();
  }



  template <int dim>
  typename Terrain<dim>::Value
  Terrain<dim>::at(const Point<dim> &x) const
  {
    const Place place = place_on_map(x);
    const auto  value = heights_->at(place.x, place.origin);
    const auto &map   = heights_->raster();
    AssertThrow(value.has_value(),
                ExcUser(text("The raster '",
                             name_,
                             "' has no value at (",
                             x,
                             ") m of the mesh, which is easting ",
                             place.origin[0] + place.x[0],
                             " m, northing ",
                             place.origin[1] + place.x[1],
                             " m. It was read from ",
                             map.west,
                             " m to ",
                             map.east(),
                             " m and from ",
                             map.south,
                             " m to ",
                             map.north(),
                             " m, and may have places without data. Soil could "
                             "come there: make the mesh smaller, move it "
                             "('Grid/Origin', 'Section'), or fill the raster "
                             "(gdal_fillnodata.py). A raster in degrees needs "
                             "a `Projection`.")));
    Value result{value->height - origin_[2], {}};
    for (unsigned int d = 0; d < dim; ++d)
      result.slope[d] = value->slope * place.axes[d];
    return result;
  }



  template class Terrain<2>;
  template class Terrain<3>;
} // namespace talus

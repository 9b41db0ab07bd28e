// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/terrain.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Terrain<dim>::Terrain(std::shared_ptr<const HeightField> heights,
                        const std::string                 &name,
                        const PlanOnMap<dim>              &plan)
    : heights_(std::move(heights))
    , name_(name)
    , plan_(plan)
  {}



  template <int dim>
  bool
  Terrain<dim>::is_known_at(const Point<dim> &x) const
  {
    const auto place = plan_.at(x);
    return heights_->at(place.x, place.origin).has_value();
  }



  template <int dim>
  typename Terrain<dim>::Value
  Terrain<dim>::at(const Point<dim> &x) const
  {
    const auto  place = plan_.at(x);
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
    Value result{value->height - (map.has_heights ? plan_.height() : 0.), {}};
    for (unsigned int d = 0; d < dim; ++d)
      result.slope[d] = value->slope * place.axes[d];
    return result;
  }



  template class Terrain<2>;
  template class Terrain<3>;
} // namespace talus

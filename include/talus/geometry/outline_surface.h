// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_outline_surface_h
#define talus_geometry_outline_surface_h

#include <talus/geometry/polygon.h>
#include <talus/geometry/surface.h>

namespace talus
{
  /// Distance from an outline in plan as a surface: inside of the outline the
  /// height is the distance to the outline, m, outside minus the distance. With
  /// the outline expressions describe limited areas, for instance a release
  /// area with sides of 45 degrees, 15 m deep: "mudline - min(15, max(0,
  /// outline))".
  class OutlineSurface : public Surface<3>
  {
  public:
    /// @p corners in the x-z plane of the mesh, m, in either sense. Throws
    /// ExcUser, starting with @p name, if the outline intersects itself or has
    /// no area.
    OutlineSurface(const std::string                   &name,
                   const std::vector<dealii::Point<2>> &corners)
      : polygon_(name, corners)
    {}

    Value
    at(const dealii::Point<3> &x) const override
    {
      const auto [distance, outwards] =
        polygon_.distance_and_normal({x[0], x[2]});
      Value value{-distance, {}};
      value.slope[0] = -outwards[0];
      value.slope[2] = -outwards[1];
      return value;
    }

    bool
    is_known_at(const dealii::Point<3> & /*x*/) const override
    {
      return true;
    }

    double
    largest_change(const dealii::Point<3> & /*x*/,
                   const double distance) const override
    {
      return distance;
    }

  private:
    Polygon polygon_;
  };
} // namespace talus

#endif

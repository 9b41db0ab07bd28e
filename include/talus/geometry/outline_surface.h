// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_outline_surface_h
#define talus_geometry_outline_surface_h

#include <talus/geometry/plan_on_map.h>
#include <talus/geometry/polygon.h>
#include <talus/geometry/surface.h>

namespace talus
{
  /// Distance from outlines in plan as a surface: inside of an outline the
  /// height is the distance to the outline, m, outside minus the distance to
  /// the nearest one. With outlines expressions describe limited areas, for
  /// instance a release area with sides of 45 degrees, 15 m deep: "mudline -
  /// min(15, max(0, outline))". Or, if each outline has a number such as a
  /// depth, the number of the nearest outline.
  template <int dim>
  class OutlineSurface : public Surface<dim>
  {
  public:
    using typename Surface<dim>::Value;

    /// @p outlines: corners on the map, easting and northing in m, in either
    /// sense; areas should not overlap. @p numbers: one of each outline, or
    /// none. Throws ExcUser, starting with @p name, if an outline intersects
    /// itself or has no area.
    OutlineSurface(const std::string                                &name,
                   const std::vector<std::vector<dealii::Point<2>>> &outlines,
                   const std::vector<double>                        &numbers,
                   const PlanOnMap<dim>                             &plan);

    Value
    at(const dealii::Point<dim> &x) const override;

    bool
    is_known_at(const dealii::Point<dim> & /*x*/) const override
    {
      return true;
    }

    double
    largest_change(const dealii::Point<dim> &x, double distance) const override;

  private:
    PlanOnMap<dim>       plan_;
    std::vector<Polygon> polygons_; ///< from the origin of the plan on
    std::vector<double>  numbers_;
  };
} // namespace talus

#endif

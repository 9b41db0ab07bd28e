// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_terrain_h
#define talus_geometry_terrain_h

#include <talus/geometry/height_field.h>
#include <talus/geometry/plan_on_map.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace talus
{
  /// Surface of a raster in the axes of the mesh; in 2-D its section along a
  /// line on the map.
  template <int dim>
  class Terrain : public Surface<dim>
  {
  public:
    using typename Surface<dim>::Value;

    /// @param heights surface on the map
    /// @param name of the file, for messages
    Terrain(std::shared_ptr<const HeightField> heights,
            const std::string                 &name,
            const PlanOnMap<dim>              &plan);

    Value
    at(const dealii::Point<dim> &x) const override;

    bool
    is_known_at(const dealii::Point<dim> &x) const override;

    double
    largest_change(const dealii::Point<dim> &,
                   const double distance) const override
    {
      return distance * heights_->bounds().slope;
    }

    const Raster &
    raster() const
    {
      return heights_->raster();
    }

  private:
    std::shared_ptr<const HeightField> heights_;
    std::string                        name_;
    PlanOnMap<dim>                     plan_;
  };
} // namespace talus

#endif

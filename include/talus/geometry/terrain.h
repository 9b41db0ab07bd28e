// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_terrain_h
#define talus_geometry_terrain_h

#include <talus/geometry/height_field.h>
#include <talus/geometry/surface.h>

#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// The surface of a raster, in the axes of the mesh. In 3-D, x is the easting
  /// and -z the northing, so that x, y (up) and z are right-handed: z points
  /// south. In 2-D it is the section along a line on the map, and x the length
  /// along that; it goes on straight beyond its ends.
  template <int dim>
  class Terrain : public Surface<dim>
  {
  public:
    using typename Surface<dim>::Value;

    /// @p name of the file is for messages. @p origin: easting, northing and
    /// height of the mesh's origin on the map, m; in 2-D only the height counts.
    /// @p section: corners of the line, in 2-D two at least, no two in a row
    /// the same.
    Terrain(std::shared_ptr<const HeightField>   heights,
            const std::string                   &name,
            const dealii::Point<3>              &origin,
            const std::vector<dealii::Point<2>> &section = {});

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
    /// A place on the map, and where the axes of the mesh go there.
    struct Place
    {
      dealii::Point<2>                      x, origin; ///< x from there
      std::array<dealii::Tensor<1, 2>, dim> axes;
    };

    Place
    place_on_map(const dealii::Point<dim> &x) const;

    std::shared_ptr<const HeightField> heights_;
    std::string                        name_;
    dealii::Point<3>                   origin_;
    std::vector<dealii::Point<2>>      section_;
    std::vector<double>                lengths_; ///< along it, to each corner
  };
} // namespace talus

#endif

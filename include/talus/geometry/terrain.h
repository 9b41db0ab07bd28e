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
  /// Surface of a raster in the axes of the mesh. In 3-D, x is the easting and
  /// -z the northing: x, y (up) and z are right-handed, and z points south. In
  /// 2-D the surface is the section along a line on the map, and x the length
  /// along the line, which extends straight beyond both ends.
  template <int dim>
  class Terrain : public Surface<dim>
  {
  public:
    using typename Surface<dim>::Value;

    /// @param heights surface on the map
    /// @param name of the file, for messages
    /// @param origin easting, northing and height of the mesh's origin on the
    ///   map, m; in 2-D only the height counts
    /// @param section corners of the line: in 2-D at least two, successive
    ///   corners differ
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
    /// Place on the map, with the directions of the axes of the mesh.
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
    std::vector<double>                lengths_; ///< length of the line up to
                                                 ///< each corner
  };
} // namespace talus

#endif

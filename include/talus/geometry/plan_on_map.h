// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_plan_on_map_h
#define talus_geometry_plan_on_map_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace talus
{
  /// Map of the plan of the mesh. In 3-D, x is the easting and -z
  /// the northing: x, y (up) and z are right-handed, and z points south. In 2-D
  /// x is the length along a line on the map, which extends straight beyond
  /// both ends.
  template <int dim>
  class PlanOnMap
  {
  public:
    /// Place on the map, with the directions of the axes of the mesh.
    struct Place
    {
      dealii::Point<2>                      x, origin; ///< x from there, m
      std::array<dealii::Tensor<1, 2>, dim> axes;
    };

    /// @param origin easting, northing and height of the mesh's origin on the
    ///   map, m; in 2-D only the height counts
    /// @param section corners of the line: in 2-D at least two, successive
    ///   corners differ
    PlanOnMap(const dealii::Point<3>              &origin,
              const std::vector<dealii::Point<2>> &section = {});

    Place
    at(const dealii::Point<dim> &x) const;

    /// Return easting and northing, m, of the origin of the mesh; in 2-D of the
    /// first corner of the line.
    dealii::Point<2>
    origin() const
    {
      return dim == 3 ? dealii::Point<2>(origin_[0], origin_[1]) : section_[0];
    }

    /// Return the height of the mesh's origin, m.
    double
    height() const
    {
      return origin_[2];
    }

  private:
    dealii::Point<3>              origin_;
    std::vector<dealii::Point<2>> section_;
    std::vector<double> lengths_; ///< length of the line up to each corner
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_pipe_h
#define talus_geometry_pipe_h

#include <talus/geometry/shape.h>

#include <deal.II/base/bounding_box.h>

#include <deal.II/numerics/rtree.h>

#include <utility>
#include <vector>

namespace talus
{
  /// Round pipe along a polyline: all places within the radius of the polyline,
  /// cylinders with spheres of the same radius at the joints and ends.
  class Pipe : public Shape<3>
  {
  public:
    /// @p axis has at least two corners, m; neighbours differ.
    Pipe(std::vector<dealii::Point<3>> axis, double radius);

    double
    signed_distance(const dealii::Point<3> &x) const override;

    dealii::Tensor<1, 3>
    normal(const dealii::Point<3> &x) const override;

    std::pair<double, dealii::Tensor<1, 3>>
    distance_and_normal(const dealii::Point<3> &x) const override;

    Box<3>
    bounding_box() const override
    {
      return box_;
    }

    double
    width() const override
    {
      return 2. * radius_;
    }

  private:
    /// Place on the axis and the number of the segment at the place.
    struct Nearest
    {
      dealii::Point<3> place;
      unsigned int     segment;
    };

    Nearest
    nearest_on_axis(const dealii::Point<3> &x) const;

    std::vector<dealii::Point<3>>                                  axis_;
    double                                                         radius_;
    Box<3>                                                         box_;
    dealii::RTree<std::pair<dealii::BoundingBox<3>, unsigned int>> segments_;
  };
} // namespace talus

#endif

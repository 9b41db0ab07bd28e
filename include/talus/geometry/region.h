// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_region_h
#define talus_geometry_region_h

#include <talus/geometry/box_index.h>
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/shape.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <vector>

namespace talus
{
  /// Part of a box inside a region.
  template <int dim>
  struct PartInside
  {
    double             volume = 0.; ///< m^dim
    dealii::Point<dim> centroid;    ///< undefined for volume 0
    /// Mean square of the distance from the centroid along each axis, m^2: for
    /// a box a twelfth of the squared length.
    dealii::Tensor<1, dim> variance;
  };



  /// Intersection of some shapes minus some solids. The shapes must outlive the
  /// region.
  template <int dim>
  class Region
  {
  public:
    /// Unbounded region, before any restrict_to().
    Region() = default;

    explicit Region(const Shape<dim> &shape)
    {
      restrict_to(shape);
    }

    void
    restrict_to(const Shape<dim> &shape)
    {
      for (const Shape<dim> *part : shape.parts())
        limits_.push_back({part, 1.});
    }

    /// Cut away @p solids, replacing solids of earlier calls.
    void
    cut_away(const std::vector<const Shape<dim> *> &solids);

    /// Return whether the region contains @p x; the surfaces of shapes and
    /// solids belong to the region.
    bool
    contains(const dealii::Point<dim> &x) const;

    /// Return the largest of the distances to the surfaces, m: not positive if
    /// and only if the region contains @p x, up to round-off.
    double
    signed_distance(const dealii::Point<dim> &x) const;

    /// Return whether a part of @p box may lie in the region; false only if all
    /// of the box is outside, at much lower cost than part_inside().
    bool
    may_overlap(const Box<dim> &box) const;

    /// Return the part of @p box in the region, from signed distances that are
    /// linear on simplices. The box is halved at least twice, until the
    /// distances are linear to a thousandth of the box, and near corners of
    /// surfaces at most six times (3-D: four). Planes are exact, curved
    /// surfaces have an error of a thousandth of the box, and nothing thicker
    /// than an eighth of the box is missed.
    PartInside<dim>
    part_inside(const Box<dim> &box) const;

  private:
    /// Shape around the region (sign 1), or cut out of the region (sign -1).
    struct Limit
    {
      double
      signed_distance(const dealii::Point<dim> &x) const
      {
        return sign * shape->signed_distance(x);
      }

      const Shape<dim> *shape;
      double            sign;
    };

    using Limits = boost::container::small_vector<Limit, 4>;

    /// Distances of a limit in a box, m: evaluated once for all uses.
    struct Distances
    {
      std::array<double, 1u << dim> at_corners;
      double                        at_centre;
    };

    using DistancesOfLimits = boost::container::small_vector<Distances, 4>;

    /// Moments of the parts so far, about a place near the box.
    struct Sum
    {
      void
      add(const Simplex<dim> &simplex, double weight);
      void
      add(const Box<dim> &box);

      dealii::Point<dim>     origin;
      double                 tolerance; ///< tolerance of distances, m
      double                 volume = 0.;
      dealii::Tensor<1, dim> first, second;
    };

    static bool
    keep_those_that_cut(const Box<dim> &box, Limits &limits);
    static DistancesOfLimits
    distances_in(const Box<dim> &box, const Limits &limits);
    static bool
    are_linear(const DistancesOfLimits &distances, double tolerance);
    static bool
    have_coinciding_pair(const DistancesOfLimits &distances, double tolerance);
    static void
    add_clipped(const Box<dim>          &box,
                const Limits            &limits,
                const DistancesOfLimits &distances,
                Sum                     &sum);
    static std::vector<Simplex<dim>>
    clip(const Simplex<dim>      &simplex,
         const Box<dim>          &box,
         const Limits            &limits,
         const DistancesOfLimits &distances,
         double                   tolerance);
    static void
    add_part(const Box<dim> &box, Limits limits, unsigned int depth, Sum &sum);

    /// Return the limits by shapes, and by all solids that may be nearer to
    /// @p x than @p distance, m.
    Limits
    limits_near(const dealii::Point<dim> &x, double distance) const;

    Limits                          limits_; ///< shapes
    std::vector<const Shape<dim> *> solids_;
    BoxIndex<dim>                   index_; ///< index of the solids
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_geometry_region_h
#define talus_geometry_region_h

#include <talus/geometry/box_index.h>
#include <talus/geometry/clip_simplex.h>
#include <talus/geometry/shape.h>

#include <vector>

namespace talus
{
  /// The part of something that lies in a region.
  template <int dim>
  struct PartInside
  {
    double             volume = 0.; ///< m^dim
    dealii::Point<dim> centroid;    ///< if the volume is not 0
    /// Mean square of the distance from the centroid along each axis, m^2: a
    /// twelfth of that of the length if the part is a box.
    dealii::Tensor<1, dim> variance;
  };



  /// What lies in all of some shapes and outside of some others. The shapes
  /// must live as long as the region.
  template <int dim>
  class Region
  {
  public:
    /// All of space.
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

    /// Cut away @p solids, which are all there are.
    void
    cut_away(const std::vector<const Shape<dim> *> &solids);

    /// The surfaces of shapes and solids belong to it.
    bool
    contains(const dealii::Point<dim> &x) const;

    /// Largest of the distances to the surfaces, m: not positive if and only if
    /// the region contains @p x, up to round-off.
    double
    signed_distance(const dealii::Point<dim> &x) const;

    /// How much of @p box lies in the region, from signed distances that are
    /// linear on simplices. The box is halved until they are so to a thousandth
    /// of it, twice at least, and where surfaces have corners six times at
    /// most (in 3-D four). So planes are exact, curved surfaces right to a
    /// thousandth of the box, and what is thicker than an eighth of it is not
    /// missed.
    PartInside<dim>
    part_inside(const Box<dim> &box) const;

  private:
    /// A shape that the region lies in (sign 1) or outside of (sign -1).
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

    using Limits = std::vector<Limit>;

    /// Moments of what was found so far, about a place near it.
    struct Sum
    {
      void
      add(const Simplex<dim> &simplex);
      void
      add(const Box<dim> &box);

      dealii::Point<dim>     origin;
      double                 tolerance; ///< of distances, m
      double                 volume = 0.;
      dealii::Tensor<1, dim> first, second;
    };

    static bool
    keep_those_that_cut(const Box<dim> &box, Limits &limits);
    static bool
    are_linear(const Box<dim> &box, const Limits &limits, double tolerance);
    static std::vector<Simplex<dim>>
    clip(const Simplex<dim> &simplex, const Limits &limits, double tolerance);
    static void
    add_part(const Box<dim> &box, Limits limits, unsigned int depth, Sum &sum);

    /// Add the solids that may be nearer to @p x than @p distance, m, to the
    /// limits by shapes.
    Limits
    limits_near(const dealii::Point<dim> &x, double distance) const;

    Limits                          limits_; ///< shapes
    std::vector<const Shape<dim> *> solids_;
    BoxIndex<dim>                   index_; ///< of the solids
  };
} // namespace talus

#endif

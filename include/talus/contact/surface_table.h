// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_surface_table_h
#define talus_contact_surface_table_h

#include <talus/base/box.h>
#include <talus/geometry/shape.h>
#include <talus/grid/patch.h>

#include <array>
#include <utility>

namespace talus
{
  /// Signed distance and normal of a shape in a box, by quadratic interpolation
  /// along each axis between three places. Replaces shapes with a costly
  /// distance in the steps of a run.
  template <int dim>
  class SurfaceTable
  {
  public:
    /// Evaluate @p shape at 3^dim places of @p box, and at 2^dim further places
    /// for is_accurate().
    SurfaceTable(const Shape<dim> &shape, const Box<dim> &box);

    /// Return whether the interpolation agrees with the shape, half way between
    /// the places: distances to 1/2000 of the box, normals to 0.2 degrees.
    /// False beside edges of the surface.
    bool
    is_accurate() const
    {
      return is_accurate_;
    }

    /// Return whether @p x lies in the box or within a quarter of its length.
    bool
    reaches(const dealii::Point<dim> &x) const;

    /// Return signed distance, m, and unit normal at @p x.
    std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const dealii::Point<dim> &x) const;

  private:
    /// Signed distance, m, and components of the normal.
    using Record = std::array<double, 1 + dim>;

    Record
    record_at(const dealii::Point<dim> &x) const;

    Box<dim>                          box_;
    std::array<Record, power(3, dim)> records_; ///< x fastest
    bool                              is_accurate_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/surface_table.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Tolerances of is_accurate(): distance in lengths of the box, and sine of
    // the angle between the normals.
    constexpr double max_distance_error = 5e-4, max_normal_error = 3.5e-3;



    /// Return place @p i of a lattice of @p n places per axis in a box; the
    /// first is at @p first, and successive places are @p step apart, all in
    /// lengths of the box.
    template <int dim>
    Point<dim>
    place_in(const Box<dim>    &box,
             unsigned int       i,
             const unsigned int n,
             const double       first,
             const double       step)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d, i /= n)
        x[d] = box.lower[d] + (first + (i % n) * step) * box.length(d);
      return x;
    }



    /// Return Lagrange's quadratic polynomials of the places 0, 1/2 and 1 at
    /// @p t.
    std::array<double, 3>
    quadratics(const double t)
    {
      return {{(1. - t) * (1. - 2. * t), 4. * t * (1. - t), t * (2. * t - 1.)}};
    }
  } // namespace



  template <int dim>
  SurfaceTable<dim>::SurfaceTable(const Shape<dim> &shape, const Box<dim> &box)
    : box_(box)
    , is_accurate_(true)
  {
    for (unsigned int i = 0; i < records_.size(); ++i)
      {
        const auto [distance, normal] =
          shape.distance_and_normal(place_in(box, i, 3, 0., 0.5));
        records_[i][0] = distance;
        for (unsigned int d = 0; d < dim; ++d)
          records_[i][1 + d] = normal[d];
      }
    for (unsigned int i = 0; i < power(2, dim) && is_accurate_; ++i)
      {
        const Point<dim> x                     = place_in(box, i, 2, 0.25, 0.5);
        const auto [distance, normal]          = shape.distance_and_normal(x);
        const auto [by_table, normal_by_table] = distance_and_normal(x);
        // A NaN counts as not accurate.
        is_accurate_ =
          std::abs(by_table - distance) <= max_distance_error * box.length(0) &&
          (normal_by_table - normal).norm() <= max_normal_error;
      }
  }



  template <int dim>
  bool
  SurfaceTable<dim>::reaches(const Point<dim> &x) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (const double margin = 0.25 * box_.length(d);
          !(x[d] >= box_.lower[d] - margin && x[d] <= box_.upper[d] + margin))
        return false;
    return true;
  }



  template <int dim>
  typename SurfaceTable<dim>::Record
  SurfaceTable<dim>::record_at(const Point<dim> &x) const
  {
    std::array<std::array<double, 3>, dim> weights;
    for (unsigned int d = 0; d < dim; ++d)
      weights[d] = quadratics((x[d] - box_.lower[d]) / box_.length(d));
    Record        result{};
    const Record *record = records_.data();
    for (unsigned int row = 0; row < power(3, dim - 1); ++row)
      for (unsigned int i = 0; i < 3; ++i, ++record)
        {
          double weight = weights[0][i] * weights[1][row % 3];
          if (dim == 3)
            weight *= weights[dim - 1][row / 3];
          for (unsigned int k = 0; k < result.size(); ++k)
            result[k] += weight * (*record)[k];
        }
    return result;
  }



  template <int dim>
  std::pair<double, Tensor<1, dim>>
  SurfaceTable<dim>::distance_and_normal(const Point<dim> &x) const
  {
    const Record   record = record_at(x);
    Tensor<1, dim> normal;
    for (unsigned int d = 0; d < dim; ++d)
      normal[d] = record[1 + d];
    return {record[0], normal / normal.norm()};
  }



  template class SurfaceTable<2>;
  template class SurfaceTable<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_points_kernel_h
#define talus_points_points_kernel_h

#include <talus/base/simd.h>
#include <talus/base/small_matrix.h>
#include <talus/points/points_view.h>

// Access to columns for functions of one point. `Columns` is Points or
// PointsView; `Number` is double, or Simd for several points.

namespace talus
{
  /// Return the dim x dim tensor in column @p column at point(s) @p p.
  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
                      load_matrix(const Columns     &points,
                                  const unsigned int column,
                                  const unsigned int p)
  {
    Matrix<dim, Number> A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] = load<Number>(points.data(column, dim * i + j) + p);
    return A;
  }



  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE void
  store_matrix(Columns                   &points,
               const unsigned int         column,
               const unsigned int         p,
               const Matrix<dim, Number> &A)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        store(points.data(column, dim * i + j) + p, A[i][j]);
  }



  /// Return the velocity gradient at point(s) @p p, 1/s.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
  load_velocity_gradient(const WorkspaceView<dim> &workspace,
                         const unsigned int        p)
  {
    Matrix<dim, Number> L;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        L[i][j] = load<Number>(workspace.velocity_gradient(i, j) + p);
    return L;
  }



  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE Stress<dim, Number>
                      load_stress(const Columns &points, const unsigned int p)
  {
    Stress<dim, Number> sigma;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      sigma[c] = load<Number>(points.data(points.stress, c) + p);
    return sigma;
  }



  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE void
  store_stress(Columns                   &points,
               const unsigned int         p,
               const Stress<dim, Number> &sigma)
  {
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      store(points.data(points.stress, c) + p, sigma[c]);
  }



  /// Volumes of point(s) @p p, m^dim: of the cells of their edges.
  template <int dim, typename Number, typename Columns>
  TALUS_ALWAYS_INLINE Number
  volume_of_points(const Columns &points, const unsigned int p)
  {
    return determinant(load_matrix<dim, Number>(points, points.edges, p));
  }



  /// Contraction A : B of two symmetric 3x3 tensors.
  template <std::size_t n, typename Number>
  TALUS_ALWAYS_INLINE Number
  contract(const std::array<Number, n> &A, const std::array<Number, n> &B)
  {
    Number sum = A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
    for (unsigned int c = 3; c < n; ++c)
      sum += 2. * A[c] * B[c];
    return sum;
  }



  /// Mean of the three normal components.
  template <std::size_t n, typename Number>
  TALUS_ALWAYS_INLINE Number
  mean_normal(const std::array<Number, n> &A)
  {
    return (A[0] + A[1] + A[2]) * (1. / 3.);
  }



  /// Add @p mean to the three normal components.
  template <std::size_t n, typename Number>
  TALUS_ALWAYS_INLINE std::array<Number, n>
                      add_mean(std::array<Number, n> A, const Number &mean)
  {
    for (unsigned int c = 0; c < 3; ++c)
      A[c] += mean;
    return A;
  }



  /// Return the shear stress sqrt(s:s/2) of the deviator s, comparable with the
  /// shear strength.
  template <std::size_t n, typename Number>
  TALUS_ALWAYS_INLINE Number
  shear_stress(const std::array<Number, n> &sigma)
  {
    const auto s = add_mean(sigma, Number(-mean_normal(sigma)));
    return sqrt(0.5 * contract(s, s));
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_small_matrix_h
#define talus_base_small_matrix_h

#include <talus/base/always_inline.h>

#include <array>

namespace talus
{
  /// dim x dim matrix, A[row][column].
  template <int dim, typename Number>
  struct Matrix
  {
    std::array<std::array<Number, dim>, dim> rows;

    std::array<Number, dim> &
    operator[](const unsigned int i)
    {
      return rows[i];
    }

    const std::array<Number, dim> &
    operator[](const unsigned int i) const
    {
      return rows[i];
    }
  };

  /// Number of independent components of the stress. In 2-D (plane strain) the
  /// stress out of the plane is included: xx, yy, zz, xy. In 3-D: xx, yy, zz,
  /// xy, xz, yz.
  template <int dim>
  constexpr unsigned int n_stress_components = (dim == 2 ? 4 : 6);

  /// Symmetric 3x3 tensor in the order of n_stress_components.
  template <int dim, typename Number>
  using Stress = std::array<Number, n_stress_components<dim>>;

  /// Index of component (i, j) in a Stress, for i, j < dim.
  template <int dim>
  constexpr unsigned int
  stress_index(const unsigned int i, const unsigned int j)
  {
    return i == j ? i : 2 + i + j;
  }

  static_assert(stress_index<2>(0, 1) == 3 && stress_index<3>(1, 2) == 5);



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
                      identity()
  {
    Matrix<dim, Number> I;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        I[i][j] = Number(i == j ? 1. : 0.);
    return I;
  }



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
  product(const Matrix<dim, Number> &A, const Matrix<dim, Number> &B)
  {
    Matrix<dim, Number> C;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          C[i][j] = A[i][0] * B[0][j];
          for (unsigned int k = 1; k < dim; ++k)
            C[i][j] += A[i][k] * B[k][j];
        }
    return C;
  }



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  trace(const Matrix<dim, Number> &A)
  {
    Number sum = A[0][0];
    for (unsigned int i = 1; i < dim; ++i)
      sum += A[i][i];
    return sum;
  }



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  determinant(const Matrix<dim, Number> &A)
  {
    if constexpr (dim == 2)
      return A[0][0] * A[1][1] - A[0][1] * A[1][0];
    else
      return A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) -
             A[0][1] * (A[1][0] * A[2][2] - A[1][2] * A[2][0]) +
             A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
  }



  /// Return det(I + A) - 1, without cancellation for small A.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  determinant_increment(const Matrix<dim, Number> &A)
  {
    if constexpr (dim == 2)
      return trace(A) + determinant(A);
    else
      {
        const Number second_invariant = A[0][0] * A[1][1] - A[0][1] * A[1][0] +
                                        A[0][0] * A[2][2] - A[0][2] * A[2][0] +
                                        A[1][1] * A[2][2] - A[1][2] * A[2][1];
        return trace(A) + second_invariant + determinant(A);
      }
  }



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Matrix<dim, Number>
                      inverse(const Matrix<dim, Number> &A)
  {
    Matrix<dim, Number> B;
    const Number        scale = 1. / determinant(A);
    if constexpr (dim == 2)
      {
        B[0][0] = A[1][1] * scale;
        B[0][1] = -A[0][1] * scale;
        B[1][0] = -A[1][0] * scale;
        B[1][1] = A[0][0] * scale;
      }
    else
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            // Cofactors with cyclic indices include the sign.
            const unsigned int a = (j + 1) % 3, b = (j + 2) % 3;
            const unsigned int c = (i + 1) % 3, d = (i + 2) % 3;
            B[i][j] = (A[a][c] * A[b][d] - A[a][d] * A[b][c]) * scale;
          }
    return B;
  }
} // namespace talus

#endif

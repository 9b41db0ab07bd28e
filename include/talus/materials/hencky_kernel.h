// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hencky_kernel_h
#define talus_materials_hencky_kernel_h

#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/moduli.h>

#include <limits>

namespace talus
{
  /// Logarithmic strain ln V in the plane.
  ///
  /// b = m I + dev b has the eigenvalues m +- r, r = |dev b|, so
  ///   ln V = (ln b)/2 = (ln J)/2 I + artanh(r/m)/(2 r) dev b.
  /// With y = 2r/(m-r) = 2r (m+r)/J^2 the factor is
  ///   ln(1+y)/y (m+r)/(2 J^2),
  /// well behaved for equal eigenvalues and for any stretch.
  template <typename Number>
  TALUS_ALWAYS_INLINE Stress<2, Number>
  logarithmic_strain(const DeformationState<2, Number> &state)
  {
    const auto                      &b = state.b_minus_1;
    const EigenvalueRange<2, Number> range(b);
    const Number m = 1. + range.mean, J = 1. + state.J_minus_1;
    const Number r      = max(range.distance, Number(1e-100));
    const Number y      = 2. * r * (m + r) / (J * J);
    const Number factor = 0.5 * log1p_by_series(y) / y * (m + r) / (J * J);

    const Number mean = 0.5 * state.log_J;
    const Number d    = factor * 0.5 * (b[0] - b[1]);
    return {{mean + d, mean - d, Number{}, factor * b[3]}};
  }



  /// Apply one Jacobi rotation of the axes @p p and @p q to @p A, so that A_pq
  /// vanishes. The columns of @p n rotate accordingly.
  template <typename Number>
  TALUS_ALWAYS_INLINE void
  rotate_axes(Matrix<3, Number> &A,
              Matrix<3, Number> &n,
              const unsigned int p,
              const unsigned int q)
  {
    // Root of t^2 + t (A_qq - A_pp)/A_pq = 1 of smaller magnitude; zero if
    // A_pq is zero.
    const Number half = 0.5 * (A[q][q] - A[p][p]);
    const Number root = sqrt(half * half + A[p][q] * A[p][q]) +
                        std::numeric_limits<double>::min();
    const Number t = A[p][q] / (half + select(half < Number(0.), -root, root));
    const Number c = 1. / sqrt(1. + t * t), s = t * c;

    const unsigned int r = 3 - p - q;
    A[p][p] -= t * A[p][q];
    A[q][q] += t * A[p][q];
    A[p][q] = A[q][p] = Number{};
    const Number A_rp = A[r][p], A_rq = A[r][q];
    A[r][p] = A[p][r] = c * A_rp - s * A_rq;
    A[r][q] = A[q][r] = s * A_rp + c * A_rq;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const Number n_p = n[i][p], n_q = n[i][q];
        n[i][p] = c * n_p - s * n_q;
        n[i][q] = s * n_p + c * n_q;
      }
  }



  /// Compute the principal directions of @p A, the columns of the result; A
  /// becomes diagonal. Jacobi's method is accurate also for equal eigenvalues
  /// and has no branches. Each sweep reduces off-diagonal entries to third
  /// order; five sweeps reach round-off.
  template <typename Number>
  TALUS_ALWAYS_INLINE Matrix<3, Number>
                      principal_directions(Matrix<3, Number> &A)
  {
    auto n = identity<3, Number>();
    for (unsigned int sweep = 0; sweep < 5; ++sweep)
      {
        rotate_axes(A, n, 0, 1);
        rotate_axes(A, n, 0, 2);
        rotate_axes(A, n, 1, 2);
      }
    return n;
  }



  /// Logarithmic strain in space, by the principal directions of b - I.
  template <typename Number>
  TALUS_ALWAYS_INLINE Stress<3, Number>
  logarithmic_strain(const DeformationState<3, Number> &state)
  {
    Matrix<3, Number> A;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        A[i][j] = A[j][i] = state.b_minus_1[stress_index<3>(i, j)];
    const auto n = principal_directions(A);

    Stress<3, Number> strain{};
    for (unsigned int k = 0; k < 3; ++k)
      {
        const Number log_l = 0.5 * log1p_by_series(A[k][k]);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            strain[stress_index<3>(i, j)] += log_l * n[i][k] * n[j][k];
      }
    return strain;
  }



  struct HenckyEnergy
  {
    Moduli moduli;

    template <int dim, typename Number>
    StateResponse<dim, Number>
    response(const DeformationState<dim, Number> &state) const
    {
      const auto deviator =
        add_mean(logarithmic_strain(state), Number(-state.log_J * (1. / 3.)));
      const Number mean = moduli.bulk * state.log_J;

      StateResponse<dim, Number> result;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        result.kirchhoff[c] = 2. * moduli.mu * deviator[c];
      result.kirchhoff = add_mean(result.kirchhoff, mean);
      result.energy =
        0.5 * mean * state.log_J + moduli.mu * contract(deviator, deviator);
      return result;
    }

    /// J times an upper bound of the acoustic tensor's eigenvalues, which is
    /// lambda + 2 mu in the undeformed state. For direction n and polarisation
    /// a, with tau = tau_min I + tau', the spatial tangent and the stress give
    ///   (lambda + mu - tau_min) (n.a)^2 + mu + n.tau'.n
    /// at most, where tau_min = lambda ln J + 2 mu ln l_min and
    /// n.tau'.n <= 2 mu ln(l_max/l_min). In 2-D waves run in the plane and see
    /// the stretches l in the plane only.
    template <int dim, typename Number>
    Number
    largest_modulus(const DeformationState<dim, Number> &state) const
    {
      const EigenvalueRange<dim, Number> strain(logarithmic_strain(state));
      const Number log_l_max = strain.mean + strain.distance;
      const Number log_l_min = strain.mean - strain.distance;
      const Number longitudinal =
        moduli.lambda * (1. - state.log_J) + moduli.mu * (1. - 2. * log_l_min);
      return max(longitudinal, Number{}) +
             moduli.mu * (1. + 2. * (log_l_max - log_l_min));
    }
  };
} // namespace talus

#endif

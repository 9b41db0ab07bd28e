// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_load_step_h
#define talus_materials_load_step_h

#include <talus/base/dual.h>
#include <talus/materials/kinematics_kernel.h>
#include <talus/materials/material_model.h>

// A step of a quasi-static load with the formulas of a dynamic step, and the
// derivatives of the formulas: the interface of laws to the search for
// equilibrium.

namespace talus
{
  /// Displacement gradient H of the step at point @p p, with its derivatives by
  /// itself.
  template <int dim>
  inline Matrix<dim, Dual<dim * dim>>
  load_independent_gradient(const WorkspaceView<dim> &workspace,
                            const unsigned int        p)
  {
    const auto H = load_velocity_gradient<dim, double>(workspace, p);
    Matrix<dim, Dual<dim * dim>> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          result[i][j]                         = H[i][j];
          result[i][j].derivative[dim * i + j] = 1.;
        }
    return result;
  }



  template <int dim, typename Number>
  inline Matrix<dim, Number>
  identity_plus(Matrix<dim, Number> A)
  {
    for (unsigned int i = 0; i < dim; ++i)
      A[i][i] += 1.;
    return A;
  }



  /// Strain of a step with infinitesimal displacement.
  template <int dim, typename Number>
  inline StrainIncrement<dim, Number>
  small_strain_increment(const Matrix<dim, Number> &H)
  {
    StrainIncrement<dim, Number> strain;
    strain.volumetric = trace(H);
    Stress<dim, Number> D{};
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        D[stress_index<dim>(i, j)] = 0.5 * (H[i][j] + H[j][i]);
    strain.deviatoric    = add_mean(D, Number(strain.volumetric * (-1. / 3.)));
    strain.half_rotation = half_rotation(Matrix<dim, Number>{});
    return strain;
  }



  template <int dim, typename Number>
  inline StrainIncrement<dim, Number>
  strain_of_load_step(const Matrix<dim, Number> &H, const StrainMeasure measure)
  {
    if (measure == StrainMeasure::small)
      return small_strain_increment(H);
    Motion<dim, Number> motion;
    motion.increment  = H;
    motion.dilatation = determinant_increment(H);
    return strain_increment(motion);
  }



  /// Store the first Piola-Kirchhoff stress, seen from the start of the step,
  /// and its derivative in @p linearization. @p kirchhoff is det(I + H) times
  /// the Cauchy stress, Pa.
  template <int dim>
  inline void
  store_nominal(const Stress<dim, Dual<dim * dim>> &kirchhoff,
                const Matrix<dim, Dual<dim * dim>> &H,
                const StrainMeasure                 measure,
                StressTangent<dim>                 &linearization)
  {
    using Number = Dual<dim * dim>;
    const auto inverse_f =
      (measure == StrainMeasure::large ? inverse(identity_plus(H))
                                       : identity<dim, Number>());
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          Number P;
          for (unsigned int k = 0; k < dim; ++k)
            P += kirchhoff[stress_index<dim>(std::min(i, k), std::max(i, k))] *
                 inverse_f[j][k];
          linearization.stress[dim * i + j]  = P.value;
          linearization.tangent[dim * i + j] = P.derivative;
        }
  }
} // namespace talus

#endif

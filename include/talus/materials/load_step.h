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



  /// Return the stress @p sigma, Pa, and its derivative, row by row.
  template <int dim>
  inline StressTangent<dim>
  stress_tangent(const Stress<dim, Dual<dim * dim>> &sigma)
  {
    StressTangent<dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          const auto &component =
            sigma[stress_index<dim>(std::min(i, j), std::max(i, j))];
          result.stress[dim * i + j]  = component.value;
          result.tangent[dim * i + j] = component.derivative;
        }
    return result;
  }
} // namespace talus

#endif

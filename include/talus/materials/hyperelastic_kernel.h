// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_hyperelastic_kernel_h
#define talus_materials_hyperelastic_kernel_h

#include <talus/materials/kinematics_kernel.h>

namespace talus
{
  /// State of deformation, stored so that small strains keep all digits.
  template <int dim, typename Number>
  struct DeformationState
  {
    Matrix<dim, Number> A;         ///< F - I
    Stress<dim, Number> b_minus_1; ///< F F^T - I
    Number              J_minus_1; ///< det F - 1
    Number              log_J;     ///< ln det F
  };



  /// Response of a hyperelastic law, per volume of the undeformed body.
  template <int dim, typename Number>
  struct StateResponse
  {
    Stress<dim, Number> kirchhoff; ///< Kirchhoff stress tau = J sigma, Pa
    Number              energy;    ///< J/m^dim
  };



  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE DeformationState<dim, Number>
                      deformation_state(const Matrix<dim, Number> &F)
  {
    DeformationState<dim, Number> state;
    auto                         &A = state.A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] = F[i][j] - (i == j ? 1. : 0.);
    state.J_minus_1 = determinant_increment(A);
    state.log_J     = log1p_by_series(state.J_minus_1);

    auto &b = state.b_minus_1;
    b[2]    = Number{};
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          Number sum = A[i][j] + A[j][i];
          for (unsigned int k = 0; k < dim; ++k)
            sum += A[i][k] * A[j][k];
          b[stress_index<dim>(i, j)] = sum;
        }
    return state;
  }



  /// Advance point(s) @p p of a hyperelastic law by one step of @p dt seconds,
  /// with @p energy as in HyperelasticLaw. @p deformation is the column of F.
  /// Returns false if a point is inverted.
  template <int dim, typename Number, typename StrainEnergy>
  TALUS_ALWAYS_INLINE bool
  update_point_by_state(const PointsView<dim>    &points,
                        const WorkspaceView<dim> &workspace,
                        const unsigned int        deformation,
                        const unsigned int        p,
                        const double              dt,
                        const StrainEnergy       &energy)
  {
    const auto motion = advance_edges<dim, Number>(points, workspace, p, dt);
    const auto state  = deformation_state<dim, Number>(
      advance_tensor<dim>(points, deformation, p, motion.increment));
    const StateResponse<dim, Number> response = energy.response(state);

    const Number        scale = 1. / (1. + state.J_minus_1);
    Stress<dim, Number> sigma = response.kirchhoff;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      sigma[c] *= scale;
    store_stress<dim, Number>(points, p, sigma);
    const auto V0 = load<Number>(points.data(points.reference_volume) + p);
    store<Number>(points.data(points.elastic_energy) + p, V0 * response.energy);
    return all(motion.volume_after > 0.);
  }



  /// Range of the eigenvalues of @p b, in the plane or in space: mean and
  /// largest possible distance from the mean, sqrt((dim-1)/dim dev b : dev b)
  /// @cite wolkowicz1980. In 2-D the eigenvalues are mean +- distance.
  template <int dim, typename Number>
  struct EigenvalueRange
  {
    Number mean, distance;

    TALUS_ALWAYS_INLINE
    EigenvalueRange(const Stress<dim, Number> &b)
    {
      mean = b[0] + b[1];
      if (dim == 3)
        mean += b[2];
      mean *= 1. / dim;
      Number square{};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            const Number s =
              b[stress_index<dim>(i, j)] - (i == j ? mean : Number{});
            square += (i == j ? 1. : 2.) * s * s;
          }
      distance = sqrt((dim - 1.) / dim * square);
    }
  };
} // namespace talus

#endif

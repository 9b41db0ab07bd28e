#ifndef talus_materials_hyperelastic_h
#define talus_materials_hyperelastic_h

#include <talus/materials/kinematics.h>

namespace talus
{
  /// State of deformation, written so that small strains keep all digits.
  template <int dim, typename Number>
  struct DeformationState
  {
    Matrix<dim, Number> A;         ///< F - I
    Stress<dim, Number> b_minus_1; ///< F F^T - I
    Number              J_minus_1; ///< det F - 1
    Number              log_J;     ///< ln det F
  };



  /// What a hyperelastic law answers, per volume of the undeformed body.
  template <int dim, typename Number>
  struct StateResponse
  {
    Stress<dim, Number> kirchhoff; ///< Kirchhoff stress tau = J sigma, Pa
    Number              energy;    ///< J/m^dim
  };



  template <int dim, typename Number>
  inline DeformationState<dim, Number>
  deformation_state(const Matrix<dim, Number> &F)
  {
    DeformationState<dim, Number> state;
    auto                         &A = state.A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] = F[i][j] - (i == j ? 1. : 0.);
    state.J_minus_1 = determinant_increment(A);
    state.log_J     = logarithm_1p(state.J_minus_1);

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



  /// Loop of all hyperelastic laws: @p response maps a DeformationState to a
  /// StateResponse.
  template <int dim, typename Response>
  inline void
  update_by_state(Points<dim>       &points,
                  const unsigned int begin,
                  const unsigned int end,
                  const double       dt,
                  const Response    &response)
  {
    bool sound = true;
    for_lanes(begin, end, [&](const unsigned int p, auto number) {
      using Number      = decltype(number);
      const auto motion = advance_deformation<dim, Number>(points, p, dt);
      const auto state  = deformation_state<dim, Number>(motion.F);
      const StateResponse<dim, Number> answer = response(state);

      const Number        scale = 1. / (1. + state.J_minus_1);
      Stress<dim, Number> sigma = answer.kirchhoff;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        sigma[c] *= scale;
      store_stress<dim, Number>(points, p, sigma);
      const auto V0 = load<Number>(points.data(points.reference_volume) + p);
      store<Number>(points.data(points.elastic_energy) + p, V0 * answer.energy);
      sound &= all(motion.J_after > 0.);
    });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  /// Wave speed sqrt(M/rho) of all hyperelastic laws: @p modulus maps a
  /// DeformationState to J M, M the largest eigenvalue of the acoustic tensor
  /// over all directions, and rho = m/(V0 J).
  template <int dim, typename Modulus>
  inline void
  wave_speed_by_state(const Points<dim> &points,
                      const unsigned int begin,
                      const unsigned int end,
                      double            *speed,
                      const Modulus     &modulus)
  {
    for_lanes(begin, end, [&](const unsigned int p, auto number) {
      using Number     = decltype(number);
      const auto state = deformation_state<dim, Number>(
        load_matrix<dim, Number>(points, points.deformation_gradient, p));
      const auto   V0 = load<Number>(points.data(points.reference_volume) + p);
      const auto   m  = load<Number>(points.data(points.mass) + p);
      const Number JM = modulus(state);
      store<Number>(speed + (p - begin), square_root(JM * V0 / m));
    });
  }



  /// In the plane or in space: the mean of the eigenvalues of @p b and the
  /// largest distance that one of them can have from it,
  /// sqrt((dim-1)/dim dev b : dev b) @cite wolkowicz1980; in 2-D the
  /// eigenvalues are mean +- distance.
  template <int dim, typename Number>
  struct EigenvalueRange
  {
    Number mean, distance;

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
      distance = square_root((dim - 1.) / dim * square);
    }
  };
} // namespace talus

#endif

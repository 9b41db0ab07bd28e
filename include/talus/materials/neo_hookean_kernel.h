// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_neo_hookean_kernel_h
#define talus_materials_neo_hookean_kernel_h

#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/moduli.h>

namespace talus
{
  struct NeoHookeanEnergy
  {
    Moduli moduli;

    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE StateResponse<dim, Number>
    response(const DeformationState<dim, Number> &state) const
    {
      const Number pressure = moduli.lambda * state.log_J;

      StateResponse<dim, Number> result;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        result.kirchhoff[c] = moduli.mu * state.b_minus_1[c];
      result.kirchhoff = add_mean(result.kirchhoff, pressure);

      // By tr b - 3 = 2 tr A + A:A, only tr A - ln J involves a cancellation.
      Number square{};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          square += state.A[i][j] * state.A[i][j];
      result.energy =
        moduli.mu * (trace(state.A) - state.log_J + 0.5 * square) +
        0.5 * pressure * state.log_J;
      return result;
    }

    /// J times the largest eigenvalue of the acoustic tensor, Pa. In direction
    /// n the tensor is [(lambda (1 - ln J) + mu) n n + mu (n.b.n) I]/J, so the
    /// longitudinal wave along the largest stretch is the fastest; in strong
    /// tension the first factor turns negative, and the shear wave is the
    /// fastest. Exact in 2-D, an upper bound in 3-D (EigenvalueRange).
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE Number
    largest_modulus(const DeformationState<dim, Number> &state) const
    {
      const EigenvalueRange<dim, Number> b(state.b_minus_1);
      const Number                       longitudinal =
        moduli.lambda * (1. - state.log_J) + moduli.mu;
      return max(longitudinal, Number{}) +
             moduli.mu * (1. + b.mean + b.distance);
    }
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_von_mises_kernel_h
#define talus_materials_von_mises_kernel_h

#include <talus/materials/rate_law_kernel.h>

#include <limits>

namespace talus
{
  /// The radial return of von Mises' law. The plastic variable is the
  /// equivalent plastic strain; the yield stress is linear in it, but not less
  /// than the residual one.
  struct VonMisesFlow
  {
    double mu;        ///< shear modulus, Pa
    double initial;   ///< yield stress, Pa; with PointStrength of 1 Pa strength
    double hardening; ///< its slope, Pa
    double residual;  ///< yield stress, Pa

    template <std::size_t n,
              typename Number,
              typename Variable,
              typename Factor>
    TALUS_ALWAYS_INLINE Flow<Number>
                        operator()(const std::array<Number, n> &deviator,
               const Variable              &plastic_strain,
               const Factor                &strength_factor) const
    {
      const Number q = sqrt(1.5 * contract(deviator, deviator) +
                            std::numeric_limits<double>::min());
      const Number d_ep =
        plastic_increment(q, Number(plastic_strain), strength_factor);
      return {3. * modulus_of_point(mu, strength_factor) * d_ep / q, d_ep};
    }

    /// Equivalent plastic strain that brings the trial stress @p q back to the
    /// yield stress; zero where it is elastic. The yield stress is the larger
    /// of a line and a constant, so what is left of q is the smaller of two
    /// falling lines, and its root is the smaller of the two roots. All of it
    /// is multiplied by @p factor.
    template <typename Number, typename Factor>
    TALUS_ALWAYS_INLINE Number
    plastic_increment(const Number  q,
                      const Number  plastic_strain,
                      const Factor &factor) const
    {
      const auto   modulus = modulus_of_point(mu, factor);
      const auto   given   = share_of_given_strength(factor);
      const auto   slope   = hardening * given;
      const Number on_line =
        (q - initial * share_of_strength(factor) - slope * plastic_strain) *
        (1. / (3. * modulus + slope));
      const Number on_residual = (q - residual * given) * (1. / (3. * modulus));
      return max(min(on_line, on_residual), Number{});
    }
  };
} // namespace talus

#endif

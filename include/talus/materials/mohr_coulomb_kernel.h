// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_mohr_coulomb_kernel_h
#define talus_materials_mohr_coulomb_kernel_h

#include <talus/base/simd_math.h>
#include <talus/materials/rate_law_kernel.h>

#include <cmath>
#include <limits>
#include <type_traits>

namespace talus
{
  /// Share K(theta) of the shear stress t = sqrt(s:s/2) that Mohr-Coulomb's
  /// criterion compares with the strength: t K = (s_1 - s_3)/2 +
  /// (s_1 + s_3)/2 sin(phi), with the principal deviators s_1 >= s_2 >= s_3 and
  /// K = cos(theta) - sin(theta) sin(phi)/sqrt(3), where
  /// sin(3 theta) = -(3 sqrt(3)/2) J_3/t^3 @cite abbo2011. At triaxial states,
  /// where level ground at rest is, the hexagon has corners without a
  /// derivative: from 29.5 degrees on, K is a parabola in sin(3 theta), which
  /// takes up to 0.4 % of the strength.
  template <typename Number, typename Sine>
  TALUS_ALWAYS_INLINE Number
  rounded_lode_share(const Number &sine_of_triple, const Sine &sine)
  {
    constexpr double limit = 0.99965732497555726; // sin(3 * 29.5 degrees)
    const Number x = min(max(sine_of_triple, Number(-limit)), Number(limit));
    const Number theta = asin(x) * (1. / 3.);
    const Number a = cos(theta), b = sin(theta);
    const Sine   c         = sine * 0.57735026918962576;
    const Number share     = a - b * c;
    const Number inverse   = 1. / (3. * sqrt(1. - x * x)); // 1/(3 cos)
    const Number slope     = (-b - a * c) * inverse;
    const Number curvature = (9. * slope * x - share) * (inverse * inverse);
    const Number beyond    = sine_of_triple - x;
    return share + beyond * (slope + 0.5 * curvature * beyond);
  }



  /// Shear stress t K(theta), Pa, of Mohr-Coulomb's criterion; @p t is
  /// sqrt(s:s/2) of the deviator @p s. In plane strain the principal stresses
  /// are found without angles.
  template <int dim, typename Number, typename Sine>
  TALUS_ALWAYS_INLINE Number
  mohr_coulomb_shear(const Stress<dim, Number> &s,
                     const Number              &t,
                     const Sine                &sine)
  {
    const double tiny = std::numeric_limits<double>::min();
    if constexpr (dim == 2)
      {
        const auto xx       = s[stress_index<dim>(0, 0)],
                   yy       = s[stress_index<dim>(1, 1)],
                   xy       = s[stress_index<dim>(0, 1)];
        const Number middle = 0.5 * (xx + yy), half = 0.5 * (xx - yy);
        const Number radius = sqrt(half * half + xy * xy + tiny);
        const Number out    = -(xx + yy); // of plane
        const Number first  = max(Number(middle + radius), out);
        const Number third  = min(Number(middle - radius), out);
        return 0.5 * (first - third) + 0.5 * (first + third) * sine;
      }
    else
      {
        const auto at = [&s](const unsigned int i, const unsigned int j) {
          return s[stress_index<dim>(i, j)];
        };
        const Number determinant =
          at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(1, 2)) -
          at(0, 1) * (at(0, 1) * at(2, 2) - at(1, 2) * at(0, 2)) +
          at(0, 2) * (at(0, 1) * at(1, 2) - at(1, 1) * at(0, 2));
        const Number x = -2.598076211353316 * determinant / (t * t * t + tiny);
        return t * rounded_lode_share(x, sine);
      }
  }



  /// Share of sqrt(s:s/2) that is mohr_coulomb_shear() at the Lode angle of
  /// @p stress [-]; 1 without shear.
  template <int dim>
  double
  mohr_coulomb_share(const Stress<dim, double> &stress, const double sine)
  {
    const auto   s = add_mean(stress, -mean_normal(stress));
    const double t = shear_stress(stress);
    return t > 0. ? mohr_coulomb_shear<dim, double>(s, t, sine) / t : 1.;
  }



  /// Soil with friction: Mohr-Coulomb's yield criterion, exact in plane strain,
  /// with radial flow of the deviator and a dilation that in plane strain is
  /// d eps_v/d gamma_max = sin(psi), the potential of Drucker and Prager. The
  /// return is in closed form. Beyond the apex, or the cut-off, the mean stress
  /// returns to the largest tension and the deviator to what is left there.
  struct MohrCoulombFlow
  {
    double mu, bulk;  ///< elastic moduli of the law, Pa
    double cohesion;  ///< c', Pa
    double friction;  ///< tan(phi') [-]
    double dilatancy; ///< psi, radians
    double decay;     ///< decay of psi per plastic shear strain [-]
    double tension;   ///< cut-off of the mean stress, Pa
    /// Whether flow is associated, with cohesion and friction reduced by Davis'
    /// factor cos(psi) cos(phi)/(1 - sin(psi) sin(phi)) @cite davis1968.
    bool is_associated = false;

    /// Sine of the dilatancy angle after the plastic shear strain @p strain; at
    /// most @p sine of the friction angle, as more would create energy.
    template <typename Strength>
    TALUS_ALWAYS_INLINE Strength
    dilatancy_sine(const Strength &strain, const Strength &sine) const
    {
      if (dilatancy == 0.)
        return Strength(0.);
      const Strength full = decay == 0.
                              ? Strength(std::sin(dilatancy))
                              : Strength(sin(dilatancy * exp(-decay * strain)));
      return min(full, sine);
    }

    template <int dim, typename Number, typename Strength>
    TALUS_ALWAYS_INLINE Flow<Number, Number>
                        operator()(const StressStep<dim, Number> &trial,
               const Strength                &strain,
               const PointStrength<Strength> &strength) const
    {
      const double tiny    = std::numeric_limits<double>::min();
      Strength     tangent = friction * strength.factor;
      Strength     c       = cohesion * strength.factor;
      Strength     root    = sqrt(1. + tangent * tangent); // 1/cos(phi)
      Strength     sine    = tangent / root;
      Strength     flow    = dilatancy_sine(strain, sine);
      if (is_associated)
        {
          const Strength davis =
            sqrt(1. - flow * flow) / (root * (1. - flow * sine));
          tangent = davis * tangent;
          c       = davis * c;
          root    = sqrt(1. + tangent * tangent);
          flow = sine = tangent / root;
        }
      // Dilation per plastic shear strain [-].
      const Strength beta = flow / sqrt(1. + flow * flow * (1. / 3.));
      const Strength apex =
        min(Strength(tension), Strength(c / (tangent + 1e-10)));
      // Strength at mean stress 0, and at the apex.
      const Strength at_zero = c / root;
      const Strength at_apex =
        max(Strength(at_zero - apex * sine), Strength(0.));

      const auto  &s      = trial.deviator_after;
      const Number p      = trial.mean_after;
      const Number t      = sqrt(0.5 * contract(s, s) + tiny);
      const Number shear  = mohr_coulomb_shear<dim, Number>(s, t, sine);
      const Number excess = max(Number(shear + p * sine - at_zero), Number(0.));
      // Elastic moduli of the point, Pa.
      const Strength g = mu * strength.stiffness, k = bulk * strength.stiffness;
      const Number   increment = excess / (g * shear / t + k * beta * sine);
      const Number   removed   = g * increment / t;
      const Number   dilation  = beta * increment;

      const auto is_beyond =
        max(Number(p - k * dilation - apex), Number(removed - 1.)) > Number(0.);
      const Number kept = min(Number(1.), Number(at_apex / (shear + tiny)));
      return {select(is_beyond, Number(1. - kept), removed),
              increment,
              select(is_beyond,
                     Number((p - apex) * (1. / bulk * strength.compliance)),
                     dilation)};
    }
  };
} // namespace talus

#endif

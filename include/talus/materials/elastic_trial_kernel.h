// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_elastic_trial_kernel_h
#define talus_materials_elastic_trial_kernel_h

#include <talus/materials/kinematics_kernel.h>
#include <talus/materials/moduli.h>

namespace talus
{
  /// Stress at the start and at the end of a step of a law in rate form, Pa.
  /// Deviators refer to the axes at mid-step, as does the strain increment.
  template <int dim, typename Number>
  struct StressStep
  {
    Number              mean_before, mean_after;
    Stress<dim, Number> deviator_before, deviator_after;
  };



  /// Integrate Hooke's law for the Jaumann rate of the Cauchy stress
  /// objectively @cite hughes1980. The strain increment belongs to the
  /// configuration at mid-step: the old deviator is rotated to mid-step by half
  /// of the rotation of the step, and by the second half when stored. The
  /// common alternative, adding the increment to the fully rotated stress, is
  /// only of first order if strain and stress are not coaxial; see
  /// @cite simo1998, section 8.3. The mean stress follows K ln det(I + H), so
  /// that -p = K ln J on any path.
  template <int dim, typename Number, typename Modulus>
  TALUS_ALWAYS_INLINE StressStep<dim, Number>
                      elastic_trial(const Stress<dim, Number>          &sigma,
                                    const StrainIncrement<dim, Number> &strain,
                                    const ModuliOf<Modulus>            &moduli)
  {
    StressStep<dim, Number> trial;
    trial.mean_before = mean_normal(sigma);
    trial.mean_after  = trial.mean_before + moduli.bulk * strain.volumetric;

    trial.deviator_before =
      turn(strain.half_rotation, add_mean(sigma, -trial.mean_before));
    trial.deviator_after = trial.deviator_before;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      trial.deviator_after[c] += 2. * moduli.mu * strain.deviatoric[c];
    return trial;
  }



  /// Volume times deviator, mean of start and end of the step, J: the
  /// contraction with a deviatoric strain of the step, plastic or total, gives
  /// the work.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Stress<dim, Number>
                      deviatoric_force(const Motion<dim, Number>     &motion,
                                       const StressStep<dim, Number> &stress)
  {
    const Number        before = 0.5 * motion.volume_before;
    const Number        after  = 0.5 * motion.volume_after;
    Stress<dim, Number> force;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      force[c] =
        before * stress.deviator_before[c] + after * stress.deviator_after[c];
    return force;
  }



  /// Work of the mean stress by a volumetric strain of the step [-], J, by the
  /// trapezoidal rule.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  volumetric_work(const Motion<dim, Number>     &motion,
                  const StressStep<dim, Number> &stress,
                  const Number                  &volumetric_strain)
  {
    return 0.5 * volumetric_strain *
           (motion.volume_before * stress.mean_before +
            motion.volume_after * stress.mean_after);
  }



  /// Work of the stress over the step, J, by the trapezoidal rule; equal to the
  /// work of the nodal forces. At constant volume, its deviatoric part minus
  /// the work of the plastic strain is the exact change of V s:s/(4 mu), so a
  /// cycle neither creates nor loses elastic energy.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE Number
  work_of_step(const Motion<dim, Number>          &motion,
               const StrainIncrement<dim, Number> &strain,
               const StressStep<dim, Number>      &stress,
               const Stress<dim, Number>          &force)
  {
    return volumetric_work<dim, Number>(motion, stress, strain.volumetric) +
           contract(force, strain.deviatoric);
  }



  /// Turn the stress at the end of the step from the axes at mid-step to the
  /// axes at the end, and store the result.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE void
  store_turned_stress(const PointsView<dim>              &points,
                      const unsigned int                  p,
                      const StrainIncrement<dim, Number> &strain,
                      const StressStep<dim, Number>      &stress)
  {
    store_stress<dim, Number>(points,
                              p,
                              add_mean(turn(strain.half_rotation,
                                            stress.deviator_after),
                                       stress.mean_after));
  }
} // namespace talus

#endif

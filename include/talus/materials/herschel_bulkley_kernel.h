#ifndef talus_materials_herschel_bulkley_kernel_h
#define talus_materials_herschel_bulkley_kernel_h

#include <talus/base/wide_simd.h>
#include <talus/materials/radial_return_kernel.h>
#include <talus/materials/viscoplastic_return_kernel.h>

#include <limits>

namespace talus
{
  /// Strength at rest, Pa: what remoulding leaves, and what it takes away.
  struct Strength
  {
    double remoulded;
    double loss;
  };



  /// A step of point(s) up to what the return needs.
  template <int dim, typename Number>
  struct ViscoplasticTrial
  {
    Motion<dim, Number>          motion;
    StrainIncrement<dim, Number> strain;
    ElasticTrial<dim, Number>    elastic;
    Number                       shear_stress; ///< of the trial, Pa
    Number                       old_strain;   ///< plastic shear, before
    Number                       strength;     ///< at the start of the step, Pa
    Number                       loss; ///< part of it that remoulding takes, Pa
  };



  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE ViscoplasticTrial<dim, Number>
                      viscoplastic_trial(const PointsView<dim>    &points,
                                         const WorkspaceView<dim> &workspace,
                                         const unsigned int        p,
                                         const unsigned int        plastic_shear_strain,
                                         const double              dt,
                                         const Moduli             &moduli,
                                         const Strength           &strength,
                                         const double              decay,
                                         const Factor             &strength_factor)
  {
    ViscoplasticTrial<dim, Number> trial;
    trial.motion = advance_deformation<dim, Number>(points, workspace, p, dt);
    trial.strain = strain_increment(trial.motion);
    trial.elastic =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 trial.strain,
                                 moduli);
    const auto &s = trial.elastic.deviator_after;
    trial.shear_stress =
      sqrt(0.5 * contract<dim>(s, s) + std::numeric_limits<double>::min());
    trial.old_strain = load<Number>(points.data(plastic_shear_strain) + p);
    trial.loss       = Number(strength.loss) * strength_factor;
    if (decay > 0.)
      trial.loss *= exp(-decay * trial.old_strain);
    trial.strength = Number(strength.remoulded) * strength_factor + trial.loss;
    return trial;
  }



  /// The end of the step, once its plastic shear is known; false if a point was
  /// turned inside out or the plastic shear, then NaN, was not found.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE bool
  flow(const PointsView<dim>                &points,
       const unsigned int                    p,
       const unsigned int                    plastic_shear_strain,
       const double                          mu,
       const ViscoplasticTrial<dim, Number> &trial,
       const Number                         &plastic_shear)
  {
    store(points.data(plastic_shear_strain) + p,
          trial.old_strain + plastic_shear);
    return_radially<dim, Number>(points,
                                 p,
                                 trial.motion,
                                 trial.strain,
                                 trial.elastic,
                                 mu,
                                 mu * plastic_shear / trial.shear_stress);
    return all(trial.motion.J_after > 0.) && all(plastic_shear >= 0.);
  }



  /// One step of the points that follow @p p, in n_parts registers. What takes
  /// the time is the iteration for the plastic shear, whose operations wait for
  /// each other: so it is made for all registers side by side. @p factor as in
  /// with_strength_factor().
  template <int dim, typename Number, unsigned int n_parts, typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_herschel_bulkley_points(const PointsView<dim>    &points,
                                 const WorkspaceView<dim> &workspace,
                                 const unsigned int        p,
                                 const unsigned int        plastic_shear_strain,
                                 const double              dt,
                                 const Moduli             &moduli,
                                 const Strength           &strength,
                                 const ShearResistance    &resistance,
                                 const Factor             &factor)
  {
    constexpr unsigned int         width = sizeof(Number) / sizeof(double);
    ViscoplasticTrial<dim, Number> trial[n_parts];
    for (unsigned int i = 0; i < n_parts; ++i)
      trial[i] =
        viscoplastic_trial<dim, Number>(points,
                                        workspace,
                                        p + i * width,
                                        plastic_shear_strain,
                                        dt,
                                        moduli,
                                        strength,
                                        resistance.decay,
                                        factor(p + i * width, Number()));
    bool is_sound = true;
    if constexpr (n_parts == 1)
      is_sound =
        flow(points,
             p,
             plastic_shear_strain,
             moduli.mu,
             trial[0],
             plastic_shear<Number>(trial[0].shear_stress - trial[0].strength,
                                   trial[0].loss,
                                   resistance));
    else
      {
        WideSimd<n_parts> excess, loss;
        for (unsigned int i = 0; i < n_parts; ++i)
          {
            excess.part[i] = trial[i].shear_stress - trial[i].strength;
            loss.part[i]   = trial[i].loss;
          }
        const auto shear =
          plastic_shear<WideSimd<n_parts>>(excess, loss, resistance);
        for (unsigned int i = 0; i < n_parts; ++i)
          is_sound &= flow(points,
                           p + i * width,
                           plastic_shear_strain,
                           moduli.mu,
                           trial[i],
                           shear.part[i]);
      }
    return is_sound;
  }
} // namespace talus

#endif

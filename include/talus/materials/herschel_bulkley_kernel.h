#ifndef talus_materials_herschel_bulkley_kernel_h
#define talus_materials_herschel_bulkley_kernel_h

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



  /// One step of point(s) @p p; false if a point was turned inside out or its
  /// plastic strain, then NaN, was not found.
  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_herschel_bulkley_point(const PointsView<dim>    &points,
                                const WorkspaceView<dim> &workspace,
                                const unsigned int        p,
                                const unsigned int        plastic_shear_strain,
                                const double              dt,
                                const Moduli             &moduli,
                                const Strength           &strength,
                                const ShearResistance    &resistance,
                                const Factor              strength_factor)
  {
    const auto motion =
      advance_deformation<dim, Number>(points, workspace, p, dt);
    const auto strain = strain_increment(motion);
    const auto trial =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 strain,
                                 moduli);

    const Number tau =
      sqrt(0.5 * contract<dim>(trial.deviator_after, trial.deviator_after) +
           std::numeric_limits<double>::min());
    double *const xi     = points.data(plastic_shear_strain) + p;
    const Number  old_xi = load<Number>(xi);
    Number        loss   = Number(strength.loss) * strength_factor;
    if (resistance.decay > 0.)
      loss *= exp(-resistance.decay * old_xi);
    const Number d_xi =
      plastic_shear<Number>(tau - (strength.remoulded * strength_factor + loss),
                            loss,
                            resistance);
    store(xi, old_xi + d_xi);
    return_radially<dim, Number>(
      points, p, motion, strain, trial, moduli.mu, moduli.mu * d_xi / tau);
    return all(motion.J_after > 0.) && all(d_xi >= 0.);
  }
} // namespace talus

#endif

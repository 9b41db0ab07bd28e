#ifndef talus_materials_linear_elastic_kernel_h
#define talus_materials_linear_elastic_kernel_h

#include <talus/materials/elastic_trial_kernel.h>

namespace talus
{
  /// One step of point(s) @p p; false if a point was turned inside out.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE bool
  update_linear_elastic_point(const PointsView<dim>    &points,
                              const WorkspaceView<dim> &workspace,
                              const unsigned int        p,
                              const double              dt,
                              const Moduli             &moduli)
  {
    const auto motion =
      advance_deformation<dim, Number>(points, workspace, p, dt);
    const auto strain = strain_increment(motion);
    const auto trial =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 strain,
                                 moduli);
    store_turned_stress<dim, Number>(
      points, p, strain, trial.deviator_after, trial.mean_after);

    const auto V0 = load<Number>(points.data(points.reference_volume) + p);
    const auto force =
      deviatoric_force<dim, Number>(motion, V0, trial, trial.deviator_after);
    double *const energy = points.data(points.elastic_energy) + p;
    store(energy,
          load<Number>(energy) +
            work_of_step<dim, Number>(motion, V0, strain, trial, force));
    return all(motion.J_after > 0.);
  }
} // namespace talus

#endif

#ifndef talus_materials_radial_return_kernel_h
#define talus_materials_radial_return_kernel_h

#include <talus/materials/elastic_trial_kernel.h>

namespace talus
{
  /// Radial return, once the plastic strain of the step is known: the part
  /// @p removed of the trial deviator goes, which is 2 mu times the plastic
  /// strain. Stores the stress and books the work of the step as plastic and
  /// elastic.
  template <int dim, typename Number>
  TALUS_ALWAYS_INLINE void
  return_radially(const PointsView<dim>              &points,
                  const unsigned int                  p,
                  const Motion<dim, Number>          &motion,
                  const StrainIncrement<dim, Number> &strain,
                  const ElasticTrial<dim, Number>    &trial,
                  const double                        mu,
                  const Number                       &removed)
  {
    auto deviator = trial.deviator_after;
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      deviator[c] *= 1. - removed;
    store_turned_stress<dim, Number>(
      points, p, strain, deviator, trial.mean_after);

    const auto V0 = load<Number>(points.data(points.reference_volume) + p);
    const auto force =
      deviatoric_force<dim, Number>(motion, V0, trial, deviator);
    const Number plastic_work =
      removed * (0.5 / mu) * contract<dim>(force, trial.deviator_after);
    const Number work =
      work_of_step<dim, Number>(motion, V0, strain, trial, force);
    double *const elastic = points.data(points.elastic_energy) + p;
    double *const plastic = points.data(points.plastic_work) + p;
    store(elastic, load<Number>(elastic) + (work - plastic_work));
    store(plastic, load<Number>(plastic) + plastic_work);
  }
} // namespace talus

#endif

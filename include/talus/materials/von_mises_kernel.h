#ifndef talus_materials_von_mises_kernel_h
#define talus_materials_von_mises_kernel_h

#include <talus/materials/radial_return_kernel.h>

#include <limits>

namespace talus
{
  /// Yield stress as a function of the equivalent plastic strain, Pa.
  struct YieldStress
  {
    double initial;
    double hardening;
    double residual;
  };



  /// Equivalent plastic strain that brings the trial stress @p q back to the
  /// yield stress; zero where it is elastic. The yield stress is the larger
  /// of a line and a constant, so what is left of q is the smaller of two
  /// falling lines, and its root is the smaller of the two roots. All of it
  /// is multiplied by @p factor.
  template <typename Number, typename Factor>
  TALUS_ALWAYS_INLINE Number
  plastic_increment(const Number       q,
                    const Number       plastic_strain,
                    const double       mu,
                    const YieldStress &yield,
                    const Factor       factor)
  {
    const auto   hardening = yield.hardening * factor;
    const Number on_line =
      (q - yield.initial * factor - hardening * plastic_strain) *
      (1. / (3. * mu + hardening));
    const Number on_residual = (q - yield.residual * factor) * (1. / (3. * mu));
    return max(min(on_line, on_residual), Number{});
  }



  /// One step of point(s) @p p; false if a point was turned inside out.
  template <int dim, typename Number, typename Factor>
  TALUS_ALWAYS_INLINE bool
  update_von_mises_point(const PointsView<dim>    &points,
                         const WorkspaceView<dim> &workspace,
                         const unsigned int        p,
                         const unsigned int        plastic_strain,
                         const double              dt,
                         const Moduli             &moduli,
                         const YieldStress        &yield,
                         const Factor              strength_factor)
  {
    const auto motion =
      advance_deformation<dim, Number>(points, workspace, p, dt);
    const auto strain = strain_increment(motion);
    const auto trial =
      elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                 strain,
                                 moduli);

    const Number q =
      sqrt(1.5 * contract<dim>(trial.deviator_after, trial.deviator_after) +
           std::numeric_limits<double>::min());
    double *const ep     = points.data(plastic_strain) + p;
    const Number  old_ep = load<Number>(ep);
    const Number  d_ep =
      plastic_increment(q, old_ep, moduli.mu, yield, strength_factor);
    store(ep, old_ep + d_ep);
    return_radially<dim, Number>(
      points, p, motion, strain, trial, moduli.mu, 3. * moduli.mu * d_ep / q);
    return all(motion.J_after > 0.);
  }
} // namespace talus

#endif

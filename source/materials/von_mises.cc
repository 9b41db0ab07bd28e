#include <talus/base/errors.h>
#include <talus/materials/elastic_trial.h>
#include <talus/materials/von_mises.h>

#include <limits>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  namespace
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
    /// falling lines, and its root is the smaller of the two roots.
    template <typename Number>
    inline Number
    plastic_increment(const Number       q,
                      const Number       plastic_strain,
                      const double       mu,
                      const YieldStress &yield)
    {
      const Number on_line =
        (q - yield.initial - yield.hardening * plastic_strain) *
        (1. / (3. * mu + yield.hardening));
      const Number on_residual = (q - yield.residual) * (1. / (3. * mu));
      return max(min(on_line, on_residual), Number{});
    }



    /// One step of point(s) @p p; false if a point was turned inside out.
    template <int dim, typename Number>
    inline bool
    update_point(Points<dim>       &points,
                 const unsigned int p,
                 const unsigned int plastic_strain,
                 const double       dt,
                 const Moduli      &moduli,
                 const YieldStress &yield)
    {
      const auto motion = advance_deformation<dim, Number>(points, p, dt);
      const auto strain = strain_increment(motion);
      const auto trial =
        elastic_trial<dim, Number>(load_stress<dim, Number>(points, p),
                                   strain,
                                   moduli);

      // Radial return: the part `removed` of the trial deviator goes, which is
      // 2 mu times the plastic strain.
      const Number q = square_root(
        1.5 * contract<dim>(trial.deviator_after, trial.deviator_after) +
        std::numeric_limits<double>::min());
      double *const ep       = points.data(plastic_strain) + p;
      const Number  old_ep   = load<Number>(ep);
      const Number  d_ep     = plastic_increment(q, old_ep, moduli.mu, yield);
      const Number  removed  = 3. * moduli.mu * d_ep / q;
      auto          deviator = trial.deviator_after;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        deviator[c] *= 1. - removed;
      store(ep, old_ep + d_ep);
      store_turned_stress<dim, Number>(
        points, p, strain, deviator, trial.mean_after);

      const auto V0 = load<Number>(points.data(points.reference_volume) + p);
      const auto force =
        deviatoric_force<dim, Number>(motion, V0, trial, deviator);
      const Number plastic_work = removed * (0.5 / moduli.mu) *
                                  contract<dim>(force, trial.deviator_after);
      const Number work =
        work_of_step<dim, Number>(motion, V0, strain, trial, force);
      double *const elastic = points.data(points.elastic_energy) + p;
      double *const plastic = points.data(points.plastic_work) + p;
      store(elastic, load<Number>(elastic) + (work - plastic_work));
      store(plastic, load<Number>(plastic) + plastic_work);
      return all(motion.J_after > 0.);
    }
  } // namespace



  template <int dim>
  VonMises<dim>::VonMises(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
    this->add_parameter("Undrained shear strength",
                        strength_,
                        "Undrained shear strength s_u [Pa]: the shear stress "
                        "at which the undisturbed material yields in simple "
                        "shear.",
                        ParameterAcceptor::prm,
                        Double(0.));
    this->add_parameter("Hardening modulus",
                        hardening_,
                        "Slope of the yield stress sqrt(3) s_u over the "
                        "equivalent plastic strain [Pa]. Negative: the "
                        "material softens, down to the residual strength.",
                        ParameterAcceptor::prm,
                        Double());
    this->add_parameter("Residual undrained shear strength",
                        residual_strength_,
                        "Undrained shear strength [Pa] below which the "
                        "material does not soften.",
                        ParameterAcceptor::prm,
                        Double(0.));
  }



  template <int dim>
  void
  VonMises<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
    const double mu = elasticity_.moduli().mu;
    AssertThrow(
      3. * mu + hardening_ > 0.,
      ExcUser(text("Section ",
                   this->section(),
                   ": `Hardening modulus` is ",
                   hardening_,
                   " Pa, but the material must not soften faster than it can "
                   "unload elastically: give more than ",
                   -3. * mu,
                   " Pa (minus three times the shear modulus).")));
    AssertThrow(residual_strength_ <= strength_,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Residual undrained shear strength` is ",
                             residual_strength_,
                             " Pa. It must not exceed `Undrained shear "
                             "strength`, which is ",
                             strength_,
                             " Pa.")));
  }



  template <int dim>
  void
  VonMises<dim>::add_columns(Points<dim> &points)
  {
    plastic_strain_ =
      points.add_column("plastic strain", "-", 1, Inheritance::copied);
  }



  template <int dim>
  void
  VonMises<dim>::update_stress(Points<dim>       &points,
                               const unsigned int begin,
                               const unsigned int end,
                               const double       dt) const
  {
    Assert(plastic_strain_ != dealii::numbers::invalid_unsigned_int,
           dealii::ExcMessage("add_columns() was not called."));
    const Moduli      moduli = elasticity_.moduli();
    const YieldStress yield  = {std::sqrt(3.) * strength_,
                                hardening_,
                                std::sqrt(3.) * residual_strength_};
    bool              sound  = true;
    for_lanes(begin, end, [&](const unsigned int p, auto number) {
      sound &= update_point<dim, decltype(number)>(
        points, p, plastic_strain_, dt, moduli, yield);
    });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  template <int dim>
  void
  VonMises<dim>::wave_speed(const Points<dim> &points,
                            const unsigned int begin,
                            const unsigned int end,
                            double            *speed) const
  {
    elastic_wave_speed(points, begin, end, elasticity_.moduli(), speed);
  }



  template class VonMises<2>;
  template class VonMises<3>;
} // namespace talus

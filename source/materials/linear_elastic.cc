#include <talus/materials/elastic_trial.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/load_step.h>

namespace talus
{
  namespace
  {
    /// One step of point(s) @p p; false if a point was turned inside out.
    template <int dim, typename Number>
    inline bool
    update_point(Points<dim>       &points,
                 const unsigned int p,
                 const double       dt,
                 const Moduli      &moduli)
    {
      const auto motion = advance_deformation<dim, Number>(points, p, dt);
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



    /// Elastic material does not flow.
    constexpr auto no_flow = [](const unsigned int, const auto &deviator) {
      using Number = std::decay_t<decltype(deviator[0])>;
      return Flow<Number>{Number{}, Number{}};
    };
  } // namespace



  template <int dim>
  LinearElastic<dim>::LinearElastic(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
  }



  template <int dim>
  void
  LinearElastic<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
  }



  template <int dim>
  void
  LinearElastic<dim>::update_stress(Points<dim>       &points,
                                    const unsigned int begin,
                                    const unsigned int end,
                                    const double       dt) const
  {
    const Moduli moduli = elasticity_.moduli();
    bool         sound  = true;
    for_lanes(begin, end, [&](const unsigned int p, auto number) {
      sound &= update_point<dim, decltype(number)>(points, p, dt, moduli);
    });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  template <int dim>
  bool
  LinearElastic<dim>::linearize(const Points<dim>  &points,
                                const unsigned int  begin,
                                const unsigned int  end,
                                const StrainMeasure measure,
                                StressTangent<dim> *answer) const
  {
    return linearize_rate_law(
      points, begin, end, measure, elasticity_.moduli(), answer, no_flow);
  }



  template <int dim>
  void
  LinearElastic<dim>::accept(Points<dim>        &points,
                             const unsigned int  begin,
                             const unsigned int  end,
                             const StrainMeasure measure) const
  {
    accept_rate_law(points,
                    begin,
                    end,
                    measure,
                    elasticity_.moduli(),
                    dealii::numbers::invalid_unsigned_int,
                    no_flow);
  }



  template <int dim>
  void
  LinearElastic<dim>::wave_speed(const Points<dim> &points,
                                 const unsigned int begin,
                                 const unsigned int end,
                                 double            *speed) const
  {
    elastic_wave_speed(points, begin, end, elasticity_.moduli(), speed);
  }



  template class LinearElastic<2>;
  template class LinearElastic<3>;
} // namespace talus

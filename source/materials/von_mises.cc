#include <talus/base/errors.h>
#include <talus/materials/inverted_point.h>
#include <talus/materials/load_step.h>
#include <talus/materials/shear_band.h>
#include <talus/materials/strength_factor.h>
#include <talus/materials/von_mises.h>
#include <talus/materials/von_mises_kernel.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

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
  VonMises<dim>::update_stress(Points<dim>              &points,
                               const StepWorkspace<dim> &workspace,
                               const unsigned int        begin,
                               const unsigned int        end,
                               const double              dt) const
  {
    Assert(plastic_strain_ != dealii::numbers::invalid_unsigned_int,
           dealii::ExcMessage("add_columns() was not called."));
    const Moduli      moduli  = elasticity_.moduli();
    const YieldStress yield   = {std::sqrt(3.) * strength_,
                                 hardening_,
                                 std::sqrt(3.) * residual_strength_};
    const auto        columns = points.view();
    const auto        work    = workspace.view(begin, end);
    bool              sound   = true;
    with_strength_factor(
      points, this->strength_factor(), [&](const auto &factor) {
        for_each_simd(
          begin,
          end,
          [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
            sound &=
              update_von_mises_point<dim, decltype(number)>(columns,
                                                            work,
                                                            p,
                                                            plastic_strain_,
                                                            dt,
                                                            moduli,
                                                            yield,
                                                            factor(p, number));
          });
      });
    if (!sound)
      throw_inverted_point(points, begin, end);
  }



  /// Maps a point and its trial deviator to what flows.
  template <int dim>
  auto
  VonMises<dim>::flow_rule(const Points<dim> &points) const
  {
    const YieldStress yield = {std::sqrt(3.) * strength_,
                               hardening_,
                               std::sqrt(3.) * residual_strength_};
    return [yield,
            mu = elasticity_.moduli().mu,
            ep = points.data(plastic_strain_),
            this,
            &points](const unsigned int p, const auto &deviator) {
      using Number      = std::decay_t<decltype(deviator[0])>;
      const Number q    = sqrt(1.5 * contract<dim>(deviator, deviator) +
                            std::numeric_limits<double>::min());
      const Number d_ep = plastic_increment(
        q, Number(ep[p]), mu, yield, this->strength_factor(points, p));
      return Flow<Number>{3. * mu * d_ep / q, d_ep};
    };
  }



  template <int dim>
  bool
  VonMises<dim>::linearize(const Points<dim>        &points,
                           const StepWorkspace<dim> &workspace,
                           const unsigned int        begin,
                           const unsigned int        end,
                           const StrainMeasure       measure,
                           StressTangent<dim>       *answer) const
  {
    return linearize_rate_law(points,
                              workspace,
                              begin,
                              end,
                              measure,
                              elasticity_.moduli(),
                              answer,
                              flow_rule(points));
  }



  template <int dim>
  void
  VonMises<dim>::accept(Points<dim>              &points,
                        const StepWorkspace<dim> &workspace,
                        const unsigned int        begin,
                        const unsigned int        end,
                        const StrainMeasure       measure) const
  {
    accept_rate_law(points,
                    workspace,
                    begin,
                    end,
                    measure,
                    elasticity_.moduli(),
                    plastic_strain_,
                    flow_rule(points));
  }



  template <int dim>
  void
  VonMises<dim>::wave_modulus(const Points<dim> & /*points*/,
                              const unsigned int begin,
                              const unsigned int end,
                              double            *modulus) const
  {
    std::fill_n(modulus, end - begin, elasticity_.moduli().longitudinal());
  }



  template <int dim>
  double
  VonMises<dim>::shear_strength(const Points<dim> &points,
                                const unsigned int p) const
  {
    const double on_line =
      strength_ + hardening_ / std::sqrt(3.) * points.data(plastic_strain_)[p];
    return this->strength_factor(points, p) *
           std::max(on_line, residual_strength_);
  }



  // The condition of check() for the hardening modulus times the factor.
  template <int dim>
  double
  VonMises<dim>::largest_strength_factor() const
  {
    if (hardening_ >= 0. || residual_strength_ == strength_)
      return std::numeric_limits<double>::infinity();
    return -0.99 * 3. * elasticity_.moduli().mu / hardening_;
  }



  // With ep = gamma/sqrt(3) of simple shear the strength is s_u + H gamma/3.
  template <int dim>
  std::string
  VonMises<dim>::note(const double cell_size) const
  {
    const double lost = strength_ - residual_strength_;
    if (hardening_ >= 0. || lost == 0.)
      return "";
    const double strain = -3. * lost / hardening_;
    return shear_band_note(
      {this->section(), strain, lost * strain / 2., "all"},
      cell_size,
      text("keep `Hardening modulus` over the cell size at ",
           hardening_ / cell_size,
           " Pa/m, or take the law Bingham or Herschel-Bulkley, whose "
           "viscosity gives the band a width of its own."));
  }



  template class VonMises<2>;
  template class VonMises<3>;
} // namespace talus

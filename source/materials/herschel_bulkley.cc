#include <talus/base/errors.h>
#include <talus/materials/herschel_bulkley.h>
#include <talus/materials/herschel_bulkley_kernel.h>
#include <talus/materials/inverted_point.h>
#include <talus/materials/load_step.h>
#include <talus/materials/shear_band.h>
#include <talus/materials/strength_factor.h>

#include <algorithm>
#include <limits>

namespace talus
{
  using dealii::ParameterAcceptor;
  using dealii::Patterns::Double;

  namespace
  {
    /// Throw ExcPoint for the first point of [@p begin, @p end) whose plastic
    /// shear strain was not found.
    template <int dim>
    void
    throw_unsolved_point(const Points<dim> &points,
                         const unsigned int begin,
                         const unsigned int end,
                         const unsigned int plastic_shear_strain)
    {
      for (unsigned int p = begin; p < end; ++p)
        AssertThrow(points.data(plastic_shear_strain)[p] >= 0.,
                    ExcPoint(
                      text("The viscoplastic flow of point ",
                           points.data(points.id)[p],
                           " at ",
                           points.data(points.position)[p],
                           ", ",
                           points.data(points.position, 1)[p],
                           " m could not be solved for, which should not be. "
                           "Look for what throws the points there about, or "
                           "change the material's consistency.")));
    }
  } // namespace



  template <int dim>
  HerschelBulkley<dim>::HerschelBulkley(const std::string &section,
                                        const FlowLaw      flow_law)
    : MaterialModel<dim>(section)
    , flow_law_(flow_law)
  {
    const auto add = [&](const std::string &name,
                         double            &value,
                         const std::string &sentence,
                         const Double      &range = Double(0.)) {
      this->add_parameter(name, value, sentence, ParameterAcceptor::prm, range);
    };
    elasticity_.declare(*this);
    add("Undrained shear strength",
        strength_,
        "Undrained shear strength s_u [Pa]: the shear stress at which the "
        "undisturbed material yields in slow simple shear.");
    if (flow_law_ == FlowLaw::bingham)
      add("Viscosity",
          consistency_,
          "Viscosity [Pa s]: what the shear stress of flowing material gains "
          "per rate of plastic shear.");
    else
      {
        exponent_ = 0.5;
        add("Consistency",
            consistency_,
            "Consistency K [Pa s^n]: at the rate gdot of plastic shear the "
            "shear stress is s_u + K gdot^n.");
        add("Flow exponent",
            exponent_,
            "Exponent n of the rate of plastic shear [-], more than 0; below 1 "
            "the material thins with the rate.");
      }
    add("Remoulded strength ratio",
        remoulded_ratio_,
        "Undrained shear strength of the remoulded material over that of the "
        "undisturbed [-], one over the sensitivity. 1: no remoulding.",
        Double(0., 1.));
    add("Plastic shear strain to remould",
        strain_to_remould_,
        "Accumulated plastic shear strain xi_95 [-] that takes away 95 % of "
        "the strength that remoulding takes away: the strength falls as "
        "exp(-3 xi/xi_95).");
  }



  template <int dim>
  void
  HerschelBulkley<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
    AssertThrow(exponent_ > 0.,
                ExcUser(text("Section ",
                             this->section(),
                             ": `Flow exponent` is ",
                             exponent_,
                             ". Give a positive number; for strength that does "
                             "not depend on the rate set `Consistency` to "
                             "0.")));
    if (remoulded_ratio_ == 1.)
      return;
    const double least =
      3. * strength_ * (1. - remoulded_ratio_) / elasticity_.moduli().mu;
    AssertThrow(
      strain_to_remould_ > least,
      ExcUser(text("Section ",
                   this->section(),
                   ": `Plastic shear strain to remould` is ",
                   strain_to_remould_,
                   ", but the material must not soften faster than it can "
                   "unload elastically: give more than ",
                   least,
                   " (three times the strength that remoulding takes away over "
                   "the shear modulus), or set `Remoulded strength ratio` to 1 "
                   "for material that is not remoulded.")));
  }



  template <int dim>
  void
  HerschelBulkley<dim>::add_columns(Points<dim> &points)
  {
    plastic_shear_strain_ =
      points.add_column("plastic shear strain", "-", 1, Inheritance::copied);
  }



  template <int dim>
  void
  HerschelBulkley<dim>::update_stress(Points<dim>              &points,
                                      const StepWorkspace<dim> &workspace,
                                      const unsigned int        begin,
                                      const unsigned int        end,
                                      const double              dt) const
  {
    Assert(plastic_shear_strain_ != dealii::numbers::invalid_unsigned_int,
           dealii::ExcMessage("add_columns() was not called."));
    const Moduli          moduli     = elasticity_.moduli();
    const double          r          = remoulded_ratio_;
    const Strength        strength   = {r * strength_, (1. - r) * strength_};
    const ShearResistance resistance = {moduli.mu,
                                        consistency_,
                                        exponent_,
                                        r < 1. ? 3. / strain_to_remould_ : 0.,
                                        dt};
    const auto            columns    = points.view();
    const auto            work       = workspace.view(begin, end);
    bool                  sound      = true;
    with_strength_factor(
      points, this->strength_factor(), [&](const auto &factor) {
        const auto update =
          [&](const unsigned int p, auto number, auto n_parts)
            TALUS_INLINE_LAMBDA {
              sound &=
                update_herschel_bulkley_points<dim, decltype(number), n_parts>(
                  columns,
                  work,
                  p,
                  plastic_shear_strain_,
                  dt,
                  moduli,
                  strength,
                  resistance,
                  factor);
            };
        using One      = std::integral_constant<unsigned int, 1>;
        using Four     = std::integral_constant<unsigned int, 4>;
        using Bulk     = Simd<simd_width>;
        unsigned int p = begin;
        for (; p + 4 * simd_width <= end; p += 4 * simd_width)
          update(p, Bulk(), Four());
        for_each_simd(p,
                      end,
                      [&](const unsigned int p, auto number)
                        TALUS_INLINE_LAMBDA { update(p, number, One()); });
      });
    if (!sound)
      {
        throw_inverted_point(points, begin, end);
        throw_unsolved_point(points, begin, end, plastic_shear_strain_);
      }
  }



  /// Maps a point and its trial deviator to what flows if there is time enough:
  /// viscosity takes no share. Remoulding follows from one load step to the
  /// next.
  template <int dim>
  auto
  HerschelBulkley<dim>::slow_flow_rule(const Points<dim> &points) const
  {
    return [this, &points, mu = elasticity_.moduli().mu](const unsigned int p,
                                                         const auto &deviator) {
      using Number     = std::decay_t<decltype(deviator[0])>;
      const Number tau = sqrt(0.5 * contract<dim>(deviator, deviator) +
                              std::numeric_limits<double>::min());
      const Number d_xi =
        max(Number((tau - shear_strength(points, p)) / mu), Number{});
      return Flow<Number>{mu * d_xi / tau, d_xi};
    };
  }



  template <int dim>
  bool
  HerschelBulkley<dim>::linearize(const Points<dim>        &points,
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
                              slow_flow_rule(points));
  }



  template <int dim>
  void
  HerschelBulkley<dim>::accept(Points<dim>              &points,
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
                    plastic_shear_strain_,
                    slow_flow_rule(points));
  }



  template <int dim>
  void
  HerschelBulkley<dim>::wave_modulus(const Points<dim> & /*points*/,
                                     const unsigned int begin,
                                     const unsigned int end,
                                     double            *modulus) const
  {
    std::fill_n(modulus, end - begin, elasticity_.moduli().longitudinal());
  }



  template <int dim>
  double
  HerschelBulkley<dim>::shear_strength(const Points<dim> &points,
                                       const unsigned int p) const
  {
    const double xi = points.data(plastic_shear_strain_)[p];
    const double r  = remoulded_ratio_;
    return this->strength_factor(points, p) * strength_ *
           (r + (1. - r) * std::exp(-3. * xi / strain_to_remould_));
  }



  // The condition of check() for the strength times the factor.
  template <int dim>
  double
  HerschelBulkley<dim>::largest_strength_factor() const
  {
    const double lost = (1. - remoulded_ratio_) * strength_;
    if (lost == 0.)
      return std::numeric_limits<double>::infinity();
    return 0.99 * elasticity_.moduli().mu * strain_to_remould_ / (3. * lost);
  }



  // The work is the integral of s_u(xi) - r s_u0 over all xi.
  template <int dim>
  std::string
  HerschelBulkley<dim>::note(const double cell_size) const
  {
    const double lost = (1. - remoulded_ratio_) * strength_;
    if (lost == 0.)
      return "";
    const std::string viscosity =
      flow_law_ == FlowLaw::bingham ? "`Viscosity`" : "`Consistency`";
    return shear_band_note(
      {this->section(),
       strain_to_remould_,
       lost * strain_to_remould_ / 3.,
       "95 %"},
      cell_size,
      text(
        "keep `Plastic shear strain to remould` times the cell size at ",
        strain_to_remould_ * cell_size,
        " m, ",
        consistency_ > 0.
          ? text("unless ",
                 viscosity,
                 " makes the bands several cells wide, which a run on smaller "
                 "cells would show.")
          : text("or set ",
                 viscosity,
                 " to more than 0, which gives the band a width of its "
                 "own.")));
  }



  template class HerschelBulkley<2>;
  template class HerschelBulkley<3>;
} // namespace talus

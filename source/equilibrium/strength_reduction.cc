// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/strength_reduction.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  StrengthReduction::StrengthReduction()
    : ParameterAcceptor("/Strength reduction")
  {
    add_parameter("First factor",
                  first_,
                  "First number by which strengths are divided [-].",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Tolerance",
                  tolerance_,
                  "Width of the bracket of the factor of safety, over the "
                  "factor, at which the search ends [-].",
                  this->prm,
                  Patterns::Double(1e-6, 1.));
    add_parameter("Largest factor",
                  largest_,
                  "Factor above which the search ends [-]: the soil is safe "
                  "enough.",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Smallest factor",
                  smallest_,
                  "Factor below which the search ends [-]: the soil fails "
                  "with any strength.",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Smallest load step",
                  smallest_step_,
                  "Smallest fraction of the imbalance of a factor in a halved "
                  "step [-]; if it fails, a smaller reduction is tried. "
                  "Failure of a factor within 'Tolerance' of a factor with "
                  "which the soil stands is decisive: here steps go down to "
                  "'Equilibrium/Smallest load step'.",
                  this->prm,
                  smallest_load_steps());
    add_parameter("Allowed imbalance",
                  allowed_imbalance_,
                  "Largest unbalanced force of soil that stands, over the "
                  "force of the loads or of the stress, as in section "
                  "Equilibrium [-]; 0 for 0.02 times 'Tolerance'. Must be "
                  "small against 'Tolerance'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Seabed",
                  includes_seabed_,
                  "Divide friction coefficient and maximum shear stress of the "
                  "seabed, too.");
  }



  namespace
  {
    constexpr double fastest_growth = 0.5;

    // A failure counts if the trial started at most `nearby` times the
    // tolerance below the factor. Halving a bracket of twice the tolerance
    // leaves lengths slightly above the tolerance, since the tolerance is
    // relative to the lower end.
    constexpr double nearby = 1.25;

    // Facets of obstacles may give way by this share of the displacements of a
    // trial. The limits of their forces hold anyway, and the factors of
    // the cases in doc/performance.md are those with 1e-5.
    constexpr double trial_facet_tolerance = 1e-3;
  } // namespace



  void
  StrengthReduction::check() const
  {
    AssertThrow(smallest_ <= largest_,
                ExcUser(
                  text("'Strength reduction/Smallest factor' is ",
                       smallest_,
                       ", but 'Strength reduction/Largest factor' is ",
                       largest_,
                       ", which must be larger. Exchange the two values.")));
    AssertThrow(first_ <= largest_,
                ExcUser(
                  text("'Strength reduction/First factor' is ",
                       first_,
                       ", but must be at most 'Strength reduction/Largest "
                       "factor' = ",
                       largest_,
                       ". Correct one of the two values.")));
  }



  void
  StrengthReduction::begin(const double largest_strength)
  {
    // growth_ is the relative growth of a factor without upper end. A larger
    // reduction may fail because it is too large for one trial.
    lower_ = upper_ = upper_from_ = 0.;
    growth_                       = fastest_growth;
    largest_strength_             = largest_strength;
  }



  /// A narrow bracket is not enough: its upper end may have failed because the
  /// reduction from a much lower factor was too large for one trial. The upper
  /// end counts if it was tried from a factor, upper_from_, within the
  /// tolerance, up to the factor `nearby`.
  bool
  StrengthReduction::is_done() const
  {
    if (upper_ == 0.)
      return lower_ >= largest_;
    if (lower_ == 0.)
      return upper_ <= min_factor();
    return is_narrow() && upper_ - upper_from_ <= nearby * tolerance_ * lower_;
  }



  /// In this order: the first factor; upwards by growth_ while no factor has
  /// failed; downwards by a factor of 1.5 while no factor has stood; if the
  /// bracket is narrow, the upper end again, from the new lower end; otherwise
  /// the middle. Only the upper end is tried a second time.
  double
  StrengthReduction::next() const
  {
    if (lower_ == 0. && upper_ == 0.)
      return std::max(first_, min_factor());
    if (upper_ == 0.)
      // If the soil stands with less than the first factor, try the first
      // factor next. After an upper end was withdrawn, continue in small steps.
      return std::min(std::max((1. + growth_) * lower_,
                               growth_ == fastest_growth ? first_ : 0.),
                      std::max(largest_, lower_));
    if (lower_ == 0.)
      return std::max(upper_ / (1. + fastest_growth), min_factor());
    return is_narrow() ? upper_ : 0.5 * (lower_ + upper_);
  }



  /// Trials start from the largest factor that stood, so a failure means only
  /// "fails from there". An upper end that stands at its second trial is
  /// withdrawn.
  void
  StrengthReduction::record(const double factor, const bool stands)
  {
    if (!stands)
      {
        upper_      = factor;
        upper_from_ = lower_;
        return;
      }
    // The factor failed from farther below but stands now: continue in small
    // steps.
    if (factor == upper_)
      {
        upper_  = 0.;
        growth_ = tolerance_;
      }
    // Double the growth with each success, up to its initial value.
    lower_  = factor;
    growth_ = std::min(2. * growth_, fastest_growth);
  }



  /// At the upper end of the bracket the soil lacks only about the tolerance
  /// times the strength that it needs. The allowed imbalance must be small
  /// against the tolerance, as otherwise soil on the way to failure would count
  /// as balanced: with 1e-3 the slope of the paper seems to stand with 4.01
  /// instead of 3.91. Trials that only narrow the bracket give up early. Trials
  /// whose failure is the result may cut their steps as far as section
  /// Equilibrium allows.
  StaticOptions
  StrengthReduction::options(const double factor, StaticOptions options) const
  {
    options.allowed_imbalance =
      allowed_imbalance_ > 0. ? allowed_imbalance_ : 0.02 * tolerance_;
    options.contact_tolerance = 0.1 * options.allowed_imbalance;
    options.facet_tolerance   = trial_facet_tolerance;
    // No state with less strength to start from: the full load must be applied.
    if (lower_ == 0.)
      return options;
    options.n_load_steps  = 1;
    const bool decides    = factor - lower_ <= nearby * tolerance_ * lower_;
    options.max_failures  = decides ? 20 : 2;
    options.smallest_step = decides
                              ? std::min(smallest_step_, options.smallest_step)
                              : smallest_step_;
    return options;
  }



  std::string
  StrengthReduction::result() const
  {
    // Three results: no upper end, no lower end, or both; then the factor of
    // safety is the middle of the bracket.
    const std::string cannot_stand =
      is_less_than_one()
        ? " It is less than 1: the soil cannot stand with its strength."
        : "";
    if (upper_ == 0.)
      return text(std::setprecision(6),
                  "The factor of safety is more than ",
                  lower_,
                  ", where 'Strength reduction/Largest factor' ends the "
                  "search.");
    if (lower_ == 0.)
      return text(std::setprecision(6),
                  "The factor of safety is less than ",
                  upper_,
                  smallest_ >= min_factor()
                    ? ", where 'Strength reduction/Smallest factor' ends the "
                      "search."
                    : "; stronger soil would soften faster than it unloads.",
                  cannot_stand);
    return text(std::setprecision(6),
                "The factor of safety is ",
                factor(),
                ": the soil stands with its strength divided by ",
                lower_,
                " and fails with ",
                upper_,
                ".",
                cannot_stand);
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/equilibrium/strength_reduction.h>

#include <algorithm>
#include <cmath>

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
                  "Change of the factor, over the factor, while the "
                  "displacement doubles, at which the search ends [-]. If the "
                  "soil fails at once: width of the bracket of the factor.",
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
    add_parameter("Allowed imbalance",
                  allowed_imbalance_,
                  "Largest unbalanced force of soil that stands, where the "
                  "search begins, over the force of the loads or of the "
                  "stress, as in section Equilibrium [-]; 0 for a tenth of "
                  "'Tolerance'. Must be small against 'Tolerance'.",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Seabed",
                  includes_seabed_,
                  "Divide friction coefficient and maximum shear stress of the "
                  "seabed, too.");
    add_parameter("Non-associated flow",
                  flow_,
                  "Plastic flow of soil with a dilatancy angle psi below the "
                  "friction angle phi. 'as given': the factor depends on the "
                  "initial stress. 'Davis': flow is associated, with cohesion "
                  "and friction times cos(psi) cos(phi)/(1 - sin(psi) "
                  "sin(phi)), phi of the divided strength; the factor is "
                  "unique, in an infinite slope that of 'as given' with K0 < "
                  "1.",
                  this->prm,
                  Patterns::Selection("as given|Davis"));
  }



  namespace
  {
    // Iterations of easy steps, after which the next is longer, and of those
    // after which the next is as long.
    constexpr unsigned int few = 7, some = 12;

    // Facets of obstacles may give way by this share of the displacements of a
    // step. The limits of their forces hold anyway, and the factors of
    // the cases in doc/performance.md are those with 1e-5.
    constexpr double trial_facet_tolerance = 1e-3;

    // In a step of the factor more loops would carry softening beds beyond the
    // limit at once: places that slip too far in the first loops stick again
    // and bear load there.
    constexpr unsigned int largest_contact_loops = 5;

    // Steps that are found need fewer iterations.
    constexpr unsigned int largest_iterations = 15;
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
    lower_ = upper_   = 0.;
    largest_strength_ = largest_strength;
    is_done_          = false;
  }



  /// A failure with the full load does not bound the path: nothing is known of
  /// factors between.
  void
  StrengthReduction::record(const double factor, const bool stands)
  {
    (stands ? lower_ : upper_) = factor;
    if (!stands)
      return;
    upper_       = 0.;
    path_        = {};
    path_.factor = factor;
    path_.change =
      std::min(std::clamp(first_ - factor, 0.1 * factor, 0.25 * factor),
               largest_ - factor);
    growth_     = 2.;
    n_failures_ = 0;
    places_     = {{0., factor}};
    is_done_    = (factor >= largest_);
  }



  /// The kind of the steps stays while they are found. The path ends where the
  /// factor stops to grow; softening soil has its limit at the largest factor.
  void
  StrengthReduction::record_step(const bool         is_found,
                                 const unsigned int n_iterations)
  {
    // At the limit steps may fail and be found in turn without end, too short
    // for the displacement to double.
    constexpr unsigned int many = 1000;
    if (lower_ > (1. + tolerance_) * lower_before_)
      {
        lower_before_ = lower_;
        n_idle_       = 0;
      }
    if (lower_ > 0. && ++n_idle_ > many)
      {
        upper_   = lower_;
        is_done_ = true;
        return;
      }
    if (!is_found)
      return shorten_step();
    const double gain = n_iterations <= few    ? growth_
                        : n_iterations <= some ? 1.
                                               : 0.7;
    growth_           = std::min(2., 1.1 * growth_);
    n_failures_       = 0;
    lower_            = std::max(lower_, path_.factor);
    places_.emplace_back(path_.displacement, path_.factor);
    if (path_.factor >= largest_)
      {
        upper_   = 0.;
        is_done_ = true;
      }
    (path_.by_factor ? path_.change : path_.length) *= gain;
    path_.change =
      std::min({path_.change, 0.25 * path_.factor, largest_ - path_.factor});
    // Elastic soil fails with all factors above upper_.
    if (upper_ > 0. && path_.direction.empty())
      path_.change =
        std::max(0.5 * (upper_ - path_.factor), tolerance_ * path_.factor);
    // A single step may fall back to a smaller factor, and decides nothing.
    const double before = places_[places_.size() - 2].second;
    const bool   falls  = is_past_limit(before) && path_.factor < before;
    const bool   stays =
      is_past_limit(before) == is_past_limit(path_.factor) &&
      std::abs(change_by_doubling()) < tolerance_ * path_.factor;
    if (!path_.by_factor && (falls || stays))
      {
        upper_   = lower_;
        is_done_ = true;
      }
  }



  /// A factor that fails may be near the limit, where only steps of given
  /// length are found. Where they are not found either, the limit is far: steps
  /// of the factor follow, half as large as before. The failure of a factor
  /// within the tolerance is decisive.
  void
  StrengthReduction::shorten_step()
  {
    const double smallest = tolerance_ * path_.factor;
    growth_               = 1.25;
    if (path_.by_factor)
      {
        upper_          = std::max(path_.factor + path_.change, lower_);
        is_done_        = (path_.change <= 1.001 * smallest);
        path_.change    = std::max(0.5 * path_.change, smallest);
        path_.by_factor = path_.direction.empty();
      }
    else
      {
        path_.length *= 0.4;
        path_.by_factor = (++n_failures_ % 3 == 0);
      }
  }



  /// Change of the factor while the displacement doubled, by the last three
  /// steps or more [-]; infinite if it did not double.
  double
  StrengthReduction::change_by_doubling() const
  {
    const auto [s, factor] = places_.back();
    for (std::size_t n = places_.size(); n >= 4; --n)
      if (const auto [before, other] = places_[n - 4];
          before > 0. && before <= 0.5 * s)
        return (factor - other) / std::log2(s / before);
    return INFINITY;
  }



  /// The allowed imbalance must be small against the tolerance, as otherwise
  /// soil on the way to failure would count as balanced.
  StaticOptions
  StrengthReduction::options(StaticOptions options) const
  {
    options.allowed_imbalance =
      allowed_imbalance_ > 0. ? allowed_imbalance_ : 0.1 * tolerance_;
    options.contact_tolerance = 0.1 * options.allowed_imbalance;
    options.facet_tolerance   = trial_facet_tolerance;
    // No state with less strength to start from: the full load must be applied.
    if (lower_ == 0.)
      return options;
    options.n_load_steps          = 1;
    options.largest_contact_loops = largest_contact_loops;
    options.largest_iterations =
      std::min(options.largest_iterations, largest_iterations);
    return options;
  }



  std::string
  StrengthReduction::result() const
  {
    // Four results: no upper end, no lower end, the limit of the path, or a
    // bracket, with the factor of safety in its middle.
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
    const std::string found =
      upper_ > lower_ ? text(std::setprecision(6),
                             ": the soil stands with its strength divided by ",
                             lower_,
                             " and fails with ",
                             upper_,
                             ".")
      : is_past_limit(path_.factor)
        ? ", the largest of the path: the soil softens, and moves on with "
          "smaller factors."
      : std::isinf(change_by_doubling())
        ? ", where steps fail and are found in turn."
        : text(std::setprecision(2),
               ": the soil moves on with its strength divided by this; while "
               "the displacement doubled, the factor changed by ",
               std::abs(change_by_doubling()),
               ".");
    return text(std::setprecision(6),
                "The factor of safety is ",
                factor(),
                found,
                cannot_stand);
  }
} // namespace talus

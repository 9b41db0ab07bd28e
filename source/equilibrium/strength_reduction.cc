#include <talus/base/errors.h>
#include <talus/equilibrium/strength_reduction.h>

namespace talus
{
  using namespace dealii;

  StrengthReduction::StrengthReduction()
    : ParameterAcceptor("/Strength reduction")
  {
    add_parameter("First factor",
                  first_,
                  "Number that strengths are divided by first [-].",
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
                  "Factor [-] beyond which the search ends: the soil is safe "
                  "enough.",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Smallest factor",
                  smallest_,
                  "Factor [-] below which the search ends: the soil fails "
                  "whatever its strength.",
                  this->prm,
                  Patterns::Double(1e-6));
    add_parameter("Smallest load step",
                  smallest_step_,
                  "Share of the force that a factor puts out of balance, below "
                  "which a step is not halved but the soil said to fail [-].",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter("Seabed",
                  includes_seabed_,
                  "Divide friction coefficient and maximum shear stress of the "
                  "seabed, too.");
  }



  void
  StrengthReduction::begin()
  {
    lower_ = upper_ = 0.;
  }



  bool
  StrengthReduction::is_done() const
  {
    if (upper_ == 0.)
      return lower_ >= largest_;
    if (lower_ == 0.)
      return upper_ <= smallest_;
    return upper_ - lower_ <= tolerance_ * lower_;
  }



  double
  StrengthReduction::next() const
  {
    if (lower_ == 0. && upper_ == 0.)
      return first_;
    if (upper_ == 0.)
      return std::min(1.5 * lower_, largest_);
    if (lower_ == 0.)
      return std::max(upper_ / 1.5, smallest_);
    return 0.5 * (lower_ + upper_);
  }



  void
  StrengthReduction::heed(const double factor, const bool stands)
  {
    (stands ? lower_ : upper_) = factor;
  }



  std::string
  StrengthReduction::result() const
  {
    if (upper_ == 0.)
      return text("The factor of safety is more than ",
                  lower_,
                  ", where 'Strength reduction/Largest factor' ends the "
                  "search.");
    if (lower_ == 0.)
      return text("The factor of safety is less than ",
                  upper_,
                  ", where 'Strength reduction/Smallest factor' ends the "
                  "search.");
    return text("The factor of safety is ",
                0.5 * (lower_ + upper_),
                ": the soil stands with its strength divided by ",
                lower_,
                " and fails with ",
                upper_,
                ".");
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/place_expression.h>
#include <talus/problem/trigger.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Trigger<dim>::Trigger()
    : ParameterAcceptor("/Trigger")
  {
    // All fractions are between 0 and 1.
    const auto add_fraction = [this](const std::string &name,
                                     double            &value,
                                     const std::string &sentence) {
      add_parameter(name, value, sentence, this->prm, Patterns::Double(0., 1.));
    };
    add_parameter("Start time",
                  ramp_.start_time,
                  "Time at which the strength begins to fall [s].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter("Duration",
                  ramp_.duration,
                  "Time over which the strength falls, smoothly by half a "
                  "cosine [s]; 0: at once, in the step after the start time.",
                  this->prm,
                  Patterns::Double(0.));
    add_fraction("Strength fraction",
                 strength_fraction_,
                 "Fraction of the strength that remains in the end [-], "
                 "without viscosity; 1: the strength stays.");
    add_parameter("Bodies",
                  names_of_bodies_,
                  "Names of the bodies whose soil becomes weaker, separated by "
                  "commas; empty: all whose law has a strength.");
    add_parameter(
      "Region",
      region_,
      "Expression in x, y (, z) and surfaces, positive where the soil of the "
      "bodies becomes weaker, for instance 0.5 - y for a weak "
      "layer; x, y, z is the initial place, without initial "
      "displacement. Empty: everywhere.");
    add_fraction("Seabed shear stress fraction",
                 seabed_fraction_,
                 "Fraction of `Maximum shear stress` of the seabed and of "
                 "obstacles that remains in the end [-]; friction "
                 "coefficients stay. 1: no reduction.");
    add_parameter(
      "Seabed region",
      seabed_region_,
      "Expression in x, y (, z) and surfaces, positive where seabed and "
      "obstacles are brought to the fraction 'Seabed shear stress "
      "fraction', for instance 20 - abs(x) for a weak zone; a "
      "surface that softens by slip keeps there the smaller of the "
      "fraction and the share left by slip. Empty: the fraction "
      "multiplies the maximum shear stress everywhere, also what "
      "slip has left.");
  }



  /// Entries without effect are errors: a trigger that never acts would be
  /// noticed only at the end of the run.
  template <int dim>
  void
  Trigger<dim>::check(const std::vector<std::string> &names_of_bodies,
                      const Materials<dim>           &materials,
                      const bool                      has_shear_stress_limit,
                      const double                    end_time)
  {
    const bool is_on = changes_strength() || seabed_fraction_ != 1.;
    AssertThrow(is_on || (ramp_.start_time == 0. && ramp_.duration == 0. &&
                          names_of_bodies_.empty() && region_.empty() &&
                          seabed_region_.empty()),
                ExcUser("The section Trigger has entries, but nothing would "
                        "become weaker: set 'Trigger/Strength fraction' or "
                        "'Trigger/Seabed shear stress fraction' to less than "
                        "1, or remove the section."));
    AssertThrow(!is_on || ramp_.start_time < end_time,
                ExcUser(text("'Trigger/Start time' is ",
                             ramp_.start_time,
                             " s, but the run ends at ",
                             end_time,
                             " s, before anything would happen. Give an "
                             "earlier time or a later 'End time'.")));
    AssertThrow(seabed_fraction_ == 1. || has_shear_stress_limit,
                ExcUser(
                  text("'Trigger/Seabed shear stress fraction' is ",
                       seabed_fraction_,
                       ", but no face of the mesh is a seabed, and no "
                       "obstacle has a 'Maximum shear stress'. Set one in "
                       "the section Boundaries or Obstacles, or remove "
                       "the entry.")));
    AssertThrow(changes_strength() ||
                  (names_of_bodies_.empty() && region_.empty()),
                ExcUser(
                  "'Trigger/Bodies' or 'Trigger/Region' is given, but "
                  "'Trigger/Strength fraction' is 1: no soil becomes weaker. "
                  "Set the fraction to less than 1 or remove the entries."));
    AssertThrow(seabed_fraction_ != 1. || seabed_region_.empty(),
                ExcUser("'Trigger/Seabed region' is given, but 'Trigger/Seabed "
                        "shear stress fraction' is 1: no surface becomes "
                        "weaker. Set the fraction to less than 1 or remove the "
                        "region."));
    if (changes_strength())
      check_bodies(names_of_bodies, materials);
  }



  /// Set weakens_body_: the listed bodies or, without a list, all bodies with a
  /// strength. A listed body without strength is an error, an unlisted body is
  /// not.
  template <int dim>
  void
  Trigger<dim>::check_bodies(const std::vector<std::string> &names_of_bodies,
                             const Materials<dim>           &materials)
  {
    weakens_body_.assign(names_of_bodies.size(), false);
    for (unsigned int b = 0; b < names_of_bodies.size(); ++b)
      // Without a list, all bodies with a strength.
      weakens_body_[b] =
        names_of_bodies_.empty() && materials.of_body(b).has_strength();
    const std::string advice =
      ", which has no strength that could fall to 'Trigger/Strength fraction' "
      "of itself. Choose the law " +
      names_of_laws_with_strength<dim>() + ", or ";
    for (const std::string &name : names_of_bodies_)
      {
        const auto found =
          std::find(names_of_bodies.begin(), names_of_bodies.end(), name);
        AssertThrow(found != names_of_bodies.end(),
                    ExcUser("'Trigger/Bodies' lists '" + name +
                            "', but Bodies/Names lists only: " +
                            boost::algorithm::join(names_of_bodies, ", ") +
                            ". Correct the name or add the body."));
        const unsigned int b = found - names_of_bodies.begin();
        AssertThrow(materials.of_body(b).has_strength(),
                    ExcUser("'Trigger/Bodies' lists '" + name +
                            "', made of the material of section " +
                            materials.of_body(b).section() + advice +
                            "remove the body from the list."));
        weakens_body_[b] = true;
      }
    // Without a list, and without any law with a strength, nothing is left.
    AssertThrow(std::count(weakens_body_.begin(), weakens_body_.end(), true) >
                  0,
                ExcUser("All bodies are made of materials as that of section " +
                        materials.of_body(0).section() + advice +
                        "remove the section Trigger."));
  }



  /// A column of the points is kept by checkpoints, ranks and splits; copied to
  /// children.
  template <int dim>
  void
  Trigger<dim>::add_columns(Points<dim> &points)
  {
    if (changes_strength())
      weakened_ = points.add_column("weakened", "-", 1, Inheritance::copied);
  }



  // Points are chosen once: a child may lie across the edge of the region, and
  // initial places are shifted at periodic faces. Collective.
  template <int dim>
  void
  Trigger<dim>::choose_points(Points<dim>     &points,
                              const Constants &constants,
                              const Surfaces  &surfaces,
                              const MPI_Comm   communicator) const
  {
    if (!changes_strength())
      return;
    const PlaceExpression<dim> region("'Trigger/Region'",
                                      // Without a region everywhere.
                                      region_.empty() ? "1" : region_,
                                      constants,
                                      surfaces,
                                      PlaceExpression<dim>::Variables::space);
    double                     n_weakened = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const unsigned int body = points.data(points.body)[p];
        const bool         is_weakened =
          weakens_body_[body] &&
          region.at(load_place(points, points.initial_position, p)) > 0.;
        points.data(weakened_)[p] = is_weakened;
        n_weakened += is_weakened;
      }
    AssertThrow(Utilities::MPI::sum(n_weakened, communicator) > 0.,
                ExcUser(
                  "'Trigger/Region' = '" + region_ +
                  "' is positive at no point of the bodies to be weakened. "
                  "Give an expression that is positive in the weak soil, or "
                  "leave the entry empty."));
  }



  template <int dim>
  BedRegion<dim>
  Trigger<dim>::seabed_region(const Constants &constants,
                              const Surfaces  &surfaces) const
  {
    if (seabed_region_.empty())
      return {};
    const PlaceExpression<dim> region("'Trigger/Seabed region'",
                                      seabed_region_,
                                      constants,
                                      surfaces,
                                      PlaceExpression<dim>::Variables::space);
    return [region](const Point<dim> &x) { return region.at(x) > 0.; };
  }



  template <int dim>
  void
  Trigger<dim>::check_seabed_region(const unsigned int n_places) const
  {
    AssertThrow(seabed_region_.empty() || n_places > 0,
                ExcUser("'Trigger/Seabed region' = '" + seabed_region_ +
                        "' is positive at no node of a seabed and at no "
                        "surface of an obstacle. Give an expression that is "
                        "positive in the weak part of the bed, or leave the "
                        "entry empty."));
  }



  /// The factor at time @p now, the end of the step, s. Skipped while the
  /// factor is constant, nearly always: the loop over the points would cost
  /// time in each step. The factor is assigned, not multiplied, to avoid drift.
  template <int dim>
  void
  Trigger<dim>::update(Points<dim>       &points,
                       const unsigned int strength_factor,
                       const double       before,
                       const double       now) const
  {
    if (!changes_strength() || ramp_.progress(before) == ramp_.progress(now))
      return;
    // f = 1 - (1 - f_end) progress at the chosen points, 1 elsewhere.
    const double  lost     = ramp_.progress(now) * (1. - strength_fraction_);
    const double *weakened = points.data(weakened_);
    double       *factor   = points.data(strength_factor);
    for (unsigned int p = 0; p < points.size(); ++p)
      factor[p] = 1. - weakened[p] * lost;
  }



  /// Return a sentence for the log, empty without a trigger.
  template <int dim>
  std::string
  Trigger<dim>::note() const
  {
    if (!changes_strength() && seabed_fraction_ == 1.)
      return "";
    std::string what;
    if (changes_strength())
      what = text("the strength of the soil chosen in the section Trigger "
                  "falls to ",
                  strength_fraction_,
                  " of itself");
    if (seabed_fraction_ != 1.)
      what += text(what.empty() ? "" : ", and ",
                   "the seabed's maximum shear stress falls to ",
                   seabed_fraction_,
                   " of itself",
                   seabed_region_.empty() ? ""
                                          : " in the region of the section "
                                            "Trigger");
    const std::string when =
      ramp_.duration > 0.
        ? text("From t = ", ramp_.start_time, " s to ", ramp_.end_time(), " s ")
        : text("At t = ", ramp_.start_time, " s ");
    return when + what + ".";
  }



  template class Trigger<2>;
  template class Trigger<3>;
} // namespace talus

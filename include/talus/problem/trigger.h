// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_trigger_h
#define talus_problem_trigger_h

#include <talus/base/expression.h>
#include <talus/materials/materials.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// What sets a slope that is at rest in motion: within a given time the
  /// strength of some soil, or the shear stress that the seabed bears, falls to
  /// a fraction. How far it has fallen is a function of time alone, so that a
  /// resumed run goes on as it would have.
  template <int dim>
  class Trigger : public dealii::ParameterAcceptor
  {
  public:
    Trigger();

    /// To be called after parsing. Throws ExcUser if the parameters contradict
    /// each other or what they are to act on: the bodies, their materials,
    /// whether a seabed or obstacle limits the shear stress, and the end time, s.
    void
    check(const std::vector<std::string> &names_of_bodies,
          const Materials<dim>           &materials,
          bool                            has_shear_stress_limit,
          double                          end_time);

    /// True if it needs the strength factor of the points.
    bool
    changes_strength() const
    {
      return strength_fraction_ != 1.;
    }

    /// Declare the column that says which points become weaker, if any do.
    void
    add_columns(Points<dim> &points);

    /// Decide, by the initial places of the newly made points, which of them
    /// become weaker; children of a split follow their parent. Throws ExcUser
    /// if none does. Collective.
    void
    choose_points(Points<dim>     &points,
                  const Constants &constants,
                  MPI_Comm         communicator) const;

    /// Set the strength factors, in column @p strength_factor, to those of time
    /// @p now, s, if they differ from those of time @p before.
    void
    update(Points<dim> &points,
           unsigned int strength_factor,
           double       before,
           double       now) const;

    /// Share of its maximum shear stress that the seabed bears at time @p t, s.
    double
    seabed_factor(const double t) const
    {
      return 1. - progress(t) * (1. - seabed_fraction_);
    }

    /// When strengths have fallen as far as they will, s; 0 without a trigger.
    double
    end_time() const
    {
      return changes_strength() || seabed_fraction_ != 1.
               ? start_time_ + duration_
               : 0.;
    }

    /// What the log should say of it: a sentence, or nothing.
    std::string
    note() const;

  private:
    /// How far strengths have fallen at time @p t, s: from 0 to 1.
    double
    progress(double t) const;
    void
    check_bodies(const std::vector<std::string> &names_of_bodies,
                 const Materials<dim>           &materials);

    double                   start_time_        = 0.;
    double                   duration_          = 0.;
    double                   strength_fraction_ = 1.;
    double                   seabed_fraction_   = 1.;
    std::vector<std::string> names_of_bodies_;
    std::string              region_ = "";

    std::vector<bool> weakens_body_; ///< by body
    unsigned int      weakened_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif

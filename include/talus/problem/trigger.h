// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_trigger_h
#define talus_problem_trigger_h

#include <talus/base/cosine_ramp.h>
#include <talus/base/expression.h>
#include <talus/boundaries/bed_slip.h>
#include <talus/geometry/surface.h>
#include <talus/materials/materials.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Trigger of the motion of a slope at rest: within a given time the strength
  /// of some soil, or the maximum shear stress of the seabed, falls to a
  /// fraction. The progress is a function of time alone: a resumed run
  /// continues unchanged.
  template <int dim>
  class Trigger : public dealii::ParameterAcceptor
  {
  public:
    /// Surfaces with names, for use in the expressions.
    using Surfaces = std::vector<typename Surface<dim>::Named>;

    Trigger();

    /// Call after parsing. Throws ExcUser if the parameters contradict each
    /// other, the bodies, the materials or the limits of shear stress.
    /// @param names_of_bodies all bodies
    /// @param materials materials of the bodies
    /// @param has_shear_stress_limit whether a seabed or obstacle limits the
    ///   shear stress
    /// @param end_time end of the run, s
    void
    check(const std::vector<std::string> &names_of_bodies,
          const Materials<dim>           &materials,
          bool                            has_shear_stress_limit,
          double                          end_time);

    /// Return whether the trigger needs the strength factor of the points.
    bool
    changes_strength() const
    {
      return strength_fraction_ != 1.;
    }

    /// Declare the column that marks the weakened points, if any.
    void
    add_columns(Points<dim> &points);

    /// Mark the points to be weakened, by the initial places of the new points;
    /// children of a split follow the parent. Throws ExcUser if there is no
    /// point to be weakened. Collective.
    void
    choose_points(Points<dim>     &points,
                  const Constants &constants,
                  const Surfaces  &surfaces,
                  MPI_Comm         communicator) const;

    /// Set the strength factors at time @p now, s, unless unchanged since time
    /// @p before, s. @p strength_factor is the column of the points.
    void
    update(Points<dim> &points,
           unsigned int strength_factor,
           double       before,
           double       now) const;

    /// Return the region of seabeds and obstacles brought to seabed_factor();
    /// empty if the factor multiplies all maximum shear stresses.
    BedRegion<dim>
    seabed_region(const Constants &constants, const Surfaces &surfaces) const;

    /// Throw ExcUser if the trigger has a seabed region, but @p n_places, the
    /// number of places of seabed and obstacles in the region, is 0.
    void
    check_seabed_region(unsigned int n_places) const;

    /// Fraction of the maximum shear stress of the seabed at time @p t, s [-].
    double
    seabed_factor(const double t) const
    {
      return 1. - ramp_.progress(t) * (1. - seabed_fraction_);
    }

    /// Time at which strengths have reached the final values, s; 0 without a
    /// trigger.
    double
    end_time() const
    {
      return changes_strength() || seabed_fraction_ != 1. ? ramp_.end_time()
                                                          : 0.;
    }

    /// Return a sentence on the trigger for the log, or nothing.
    std::string
    note() const;

  private:
    void
    check_bodies(const std::vector<std::string> &names_of_bodies,
                 const Materials<dim>           &materials);

    CosineRamp               ramp_;
    double                   strength_fraction_ = 1.;
    double                   seabed_fraction_   = 1.;
    std::vector<std::string> names_of_bodies_;
    std::string              region_        = "";
    std::string              seabed_region_ = "";

    std::vector<bool> weakens_body_; ///< by body
    unsigned int      weakened_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif

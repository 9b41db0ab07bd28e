// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_excess_pore_pressure_h
#define talus_problem_excess_pore_pressure_h

#include <talus/base/cosine_ramp.h>
#include <talus/geometry/surface.h>
#include <talus/points/points.h>
#include <talus/problem/inputs.h>
#include <talus/problem/mudline.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Excess pore pressure u, Pa, given in place and time: the pressure of the
  /// pore water in excess of the pressure of still water. The soil carries u
  /// along: u belongs to the initial place of the soil, as the strength does,
  ///   u(X, t) = u_0(X) + g(t) (u_1(X) - u_0(X)),
  /// where g grows from 0 to 1 as half a cosine. Only the increments of u are
  /// added: what the volume of the soil changes, see WaterResponse, stays.
  /// Causes are gas from dissociating hydrate, sediment that came too fast for
  /// its water to leave, or the residual of an earthquake.
  template <int dim>
  class ExcessPorePressure : public dealii::ParameterAcceptor
  {
  public:
    ExcessPorePressure();

    /// Whether any soil has an excess pore pressure.
    bool
    exists() const
    {
      return !initial_.empty() || !final_.empty();
    }

    /// Call after parsing. Throws ExcUser if the parameters contradict each
    /// other or the bodies; @p end_time of the run, s.
    void
    check(const std::vector<std::string> &names_of_bodies, double end_time);

    /// Declare the columns, if any.
    void
    add_columns(Points<dim> &points);

    /// Return the tables of the parameters.
    std::vector<InputFile>
    tables(const std::filesystem::path &folder) const;

    /// Set u at the start and the change to come, from the initial places of
    /// the points and their overburden. Throws ExcUser where u would be more
    /// than the overburden: the soil would float. Collective.
    void
    set(Points<dim>        &points,
        const Inputs<dim>  &inputs,
        const Mudline<dim> &mudline,
        MPI_Comm            communicator) const;

    /// Whether u changes from time @p before to time @p now, s.
    bool
    changes(const double before, const double now) const
    {
      return !final_.empty() && ramp_.progress(before) != ramp_.progress(now);
    }

    /// Add what u changes from time @p before to time @p now, s; see changes().
    void
    update(Points<dim> &points, const double before, const double now) const
    {
      add(points, ramp_.progress(now) - ramp_.progress(before));
    }

    /// Whether the stage 'strength reduction' sees the pressure at the end.
    bool
    is_final_in_stage() const
    {
      return stage_value_ == "final";
    }

    /// Add the share @p grown of the whole change of u.
    void
    add(Points<dim> &points, double grown) const;

    /// Time after which u is constant, s.
    double
    end_time() const
    {
      return final_.empty() ? 0. : ramp_.end_time();
    }

    /// Return a sentence for the log, empty without excess pore pressure.
    std::string
    note() const;

  private:
    std::string              initial_, final_, stage_value_ = "initial";
    CosineRamp               ramp_;
    std::vector<std::string> names_of_bodies_;

    std::vector<bool> has_pressure_; ///< by body
    unsigned int      change_ = dealii::numbers::invalid_unsigned_int;
  };
} // namespace talus

#endif

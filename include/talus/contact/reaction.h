// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_reaction_h
#define talus_contact_reaction_h

#include <talus/base/state.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <limits>
#include <string>

namespace talus
{
  /// What the soil does to an obstacle in one step, summed over its surface.
  template <int dim>
  struct StepReaction
  {
    static constexpr unsigned int n_moments = (dim == 2 ? 1 : 3);

    dealii::Tensor<1, dim>        impulse;    ///< on the obstacle, N s
    dealii::Tensor<1, dim>        tangential; ///< its part by friction, N s
    std::array<double, n_moments> angular_impulse{}; ///< about the reference
                                                     ///< point, N m s
    double area          = 0;                        ///< in contact, m^(dim-1)
    double friction_work = 0; ///< energy that friction took from the soil, J
    double contact_work  = 0; ///< energy that normal contact took, J

    /// All of it, to be summed over the ranks.
    static constexpr unsigned int n_values = 2 * dim + n_moments + 3;

    std::array<double, n_values>
    as_list() const
    {
      std::array<double, n_values> list;
      double                      *to = list.data();
      for (unsigned int d = 0; d < dim; ++d)
        *to++ = impulse[d];
      for (unsigned int d = 0; d < dim; ++d)
        *to++ = tangential[d];
      for (const double moment : angular_impulse)
        *to++ = moment;
      for (const double value : {area, friction_work, contact_work})
        *to++ = value;
      return list;
    }

    void
    from_list(const double *list)
    {
      for (unsigned int d = 0; d < dim; ++d)
        impulse[d] = *list++;
      for (unsigned int d = 0; d < dim; ++d)
        tangential[d] = *list++;
      for (double &moment : angular_impulse)
        moment = *list++;
      area          = *list++;
      friction_work = *list++;
      contact_work  = *list++;
    }
  };



  /// The same since the start of the run, and what happened since the last row
  /// of the output. All ranks know the same.
  template <int dim>
  struct Reaction
  {
    StepReaction<dim> total; ///< since the start; the area is that of the last
                             ///< step

    double                 duration = 0;        ///< since the last row, s
    dealii::Tensor<1, dim> impulse, tangential; ///< since then, N s
    std::array<double, StepReaction<dim>::n_moments> angular_impulse{};
    double                 area_time = 0; ///< integral of the area, m^(dim-1) s
    dealii::Tensor<1, dim> least, largest; ///< force in a step since then, N

    /// Add a step of @p dt, s.
    void
    add(const StepReaction<dim> &step, const double dt)
    {
      total.impulse += step.impulse;
      total.tangential += step.tangential;
      total.area = step.area;
      total.friction_work += step.friction_work;
      total.contact_work += step.contact_work;
      for (unsigned int i = 0; i < angular_impulse.size(); ++i)
        {
          total.angular_impulse[i] += step.angular_impulse[i];
          angular_impulse[i] += step.angular_impulse[i];
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double force = step.impulse[d] / dt;
          const bool   first = (duration == 0);
          least[d]           = (first || force < least[d] ? force : least[d]);
          largest[d] = (first || force > largest[d] ? force : largest[d]);
        }
      impulse += step.impulse;
      tangential += step.tangential;
      area_time += dt * step.area;
      duration += dt;
    }

    /// A row was written.
    void
    start_interval()
    {
      const StepReaction<dim> so_far = total;
      *this                          = Reaction<dim>();
      total                          = so_far;
    }

    void
    list_state(const std::string &name, StateList &list)
    {
      const auto components = [&](const std::string &what,
                                  const std::string &unit,
                                  auto              &values,
                                  const unsigned int n) {
        list.add_components(
          name + " " + what, unit, values, n, Reduction::equal);
      };
      components("impulse", "N s", total.impulse, dim);
      components("friction impulse", "N s", total.tangential, dim);
      components("angular impulse",
                 "N m s",
                 total.angular_impulse,
                 total.angular_impulse.size());
      list.add(name + " area", "", total.area, Reduction::equal);
      list.add(name + " friction work",
               "J",
               total.friction_work,
               Reduction::equal);
      list.add(name + " contact work",
               "J",
               total.contact_work,
               Reduction::equal);
      list.add(name + " interval", "s", duration, Reduction::equal);
      components("impulse of interval", "N s", impulse, dim);
      components("friction impulse of interval", "N s", tangential, dim);
      components("angular impulse of interval",
                 "N m s",
                 angular_impulse,
                 angular_impulse.size());
      list.add(name + " area by time", "", area_time, Reduction::equal);
      components("least force", "N", least, dim);
      components("largest force", "N", largest, dim);
    }
  };
} // namespace talus

#endif

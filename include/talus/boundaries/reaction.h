// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_reaction_h
#define talus_boundaries_reaction_h

#include <talus/base/quantity.h>
#include <talus/base/state.h>

#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// What the soil does to an obstacle or a face of the mesh in one step, summed
  /// over the surface.
  template <int dim>
  struct StepReaction
  {
    static constexpr unsigned int n_moments = (dim == 2 ? 1 : 3);

    dealii::Tensor<1, dim>        impulse;    ///< of the soil, N s
    dealii::Tensor<1, dim>        tangential; ///< its part by friction, N s
    std::array<double, n_moments> angular_impulse{}; ///< about the reference
                                                     ///< point, N m s
    double area          = 0;                        ///< in contact, m^(dim-1)
    double friction_work = 0; ///< energy that friction took from the soil, J
    double contact_work  = 0; ///< energy that normal contact took, J

    /// Add an impulse that the soil got at @p arm, m, from the reference point.
    void
    add_impulse_on_soil(const dealii::Tensor<1, dim> &arm,
                        const dealii::Tensor<1, dim> &on_soil)
    {
      impulse -= on_soil;
      if constexpr (dim == 2)
        angular_impulse[0] -= arm[0] * on_soil[1] - arm[1] * on_soil[0];
      else
        {
          const auto moment = dealii::cross_product_3d(arm, on_soil);
          for (unsigned int d = 0; d < dim; ++d)
            angular_impulse[d] -= moment[d];
        }
    }

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

    /// Running mean of the force, N: weights of past steps decay as exp(-t / T)
    /// with the averaging time T, so that impacts of single steps do not count.
    dealii::Tensor<1, dim> running_mean;
    bool                   has_running_mean = false;
    dealii::Tensor<1, dim> least_mean, largest_mean; ///< of the interval, N

    /// Add a step of @p dt, s; @p averaging_time, s, is T above, or 0 for none.
    void
    add(const StepReaction<dim> &step,
        const double             dt,
        const double             averaging_time)
    {
      update_extremes(step.impulse / dt, dt, averaging_time);
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
      impulse += step.impulse;
      tangential += step.tangential;
      area_time += dt * step.area;
      duration += dt;
    }

    /// Reset the means and extremes of the interval: a row was written.
    void
    start_interval()
    {
      Reaction<dim> next;
      next.total            = total;
      next.running_mean     = running_mean;
      next.has_running_mean = has_running_mean;
      *this                 = next;
    }

    void
    list_state(const std::string &name, StateList &list);

    /// Append forces, the means of the interval and the extremes, then what
    /// happened since the start; the names begin with @p name.
    void
    list_quantities(const std::string &name, Quantities &row) const;

  private:
    void
    update_extremes(const dealii::Tensor<1, dim> &force,
                    double                        dt,
                    double                        averaging_time);
  };



  /// Sum @p steps over the ranks and add them to @p reactions, of a step of
  /// @p dt, s; @p averaging_time as in Reaction::add(). Collective.
  template <int dim>
  void
  add_to_reactions(std::vector<StepReaction<dim>> &steps,
                   double                          dt,
                   double                          averaging_time,
                   MPI_Comm                        communicator,
                   std::vector<Reaction<dim>>     &reactions);
} // namespace talus

#endif

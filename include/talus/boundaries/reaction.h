// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_reaction_h
#define talus_boundaries_reaction_h

#include <talus/base/state_list.h>

#include <deal.II/base/tensor.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// Impulse of the soil on an obstacle or a face of the mesh in one step,
  /// summed over the surface.
  template <int dim>
  struct StepReaction
  {
    static constexpr unsigned int n_moments = (dim == 2 ? 1 : 3);

    dealii::Tensor<1, dim>        impulse;           ///< total, N s
    dealii::Tensor<1, dim>        tangential;        ///< part by friction, N s
    std::array<double, n_moments> angular_impulse{}; ///< about the reference
                                                     ///< point, N m s
    double area          = 0;                        ///< in contact, m^(dim-1)
    double friction_work = 0; ///< energy that friction took from the soil, J
    double contact_work  = 0; ///< energy that normal contact took, J

    /// Add an impulse on the soil, N s, that acts at @p arm, m, from the
    /// reference point.
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

    /// Add a normal and a tangential impulse on soil that moves with the mean
    /// velocity @p v, m/s, in the step, see add_impulse_on_soil().
    void
    add_contact(const dealii::Tensor<1, dim> &arm,
                const dealii::Tensor<1, dim> &normal,
                const dealii::Tensor<1, dim> &tangential_on_soil,
                const dealii::Tensor<1, dim> &v)
    {
      add_impulse_on_soil(arm, normal + tangential_on_soil);
      tangential -= tangential_on_soil;
      friction_work -= tangential_on_soil * v;
      contact_work -= normal * v;
    }

    /// Add the sums of @p other, with the same reference point.
    void
    operator+=(const StepReaction &other)
    {
      auto       sum   = as_list();
      const auto added = other.as_list();
      for (unsigned int i = 0; i < n_values; ++i)
        sum[i] += added[i];
      from_list(sum.data());
    }

    /// Number of values in as_list(), for sums over the ranks.
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



  /// Force of the soil on an obstacle or a face of the mesh, summed over all
  /// ranks.
  template <int dim>
  struct Reaction
  {
    StepReaction<dim> last;  ///< in the last step
    StepReaction<dim> total; ///< since the start; area of the last step

    void
    add(const StepReaction<dim> &step);

    void
    list_state(const std::string &name, StateList &list);
  };



  /// Sum the shares @p steps of the ranks, one per surface, and add the sums to
  /// @p reactions. Collective.
  template <int dim>
  void
  add_to_reactions(std::vector<StepReaction<dim>> &steps,
                   MPI_Comm                        communicator,
                   std::vector<Reaction<dim>>     &reactions);
} // namespace talus

#endif

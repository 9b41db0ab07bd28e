// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/reaction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  // The mean decays exactly while the force of a step acts: it does not depend on
  // how a time with a constant force is divided into steps.
  template <int dim>
  void
  Reaction<dim>::update_extremes(const Tensor<1, dim> &force,
                                 const double          dt,
                                 const double          averaging_time)
  {
    const double weight = has_running_mean && averaging_time > 0
                            ? -std::expm1(-dt / averaging_time)
                            : 1.;
    running_mean += weight * (force - running_mean);
    has_running_mean = true;
    if (duration == 0)
      {
        least = largest = force;
        least_mean = largest_mean = running_mean;
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        least[d]        = std::min(least[d], force[d]);
        largest[d]      = std::max(largest[d], force[d]);
        least_mean[d]   = std::min(least_mean[d], running_mean[d]);
        largest_mean[d] = std::max(largest_mean[d], running_mean[d]);
      }
  }



  template <int dim>
  void
  Reaction<dim>::list_state(const std::string &name, StateList &list)
  {
    const auto components = [&](const std::string &what,
                                const std::string &unit,
                                auto              &values,
                                const unsigned int n) {
      list.add_components(name + " " + what, unit, values, n, Reduction::equal);
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
    list.add(name + " contact work", "J", total.contact_work, Reduction::equal);
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
    components("running mean of the force", "N", running_mean, dim);
    list.add(name + " has a running mean",
             "-",
             has_running_mean,
             Reduction::equal);
    components("least mean force", "N", least_mean, dim);
    components("largest mean force", "N", largest_mean, dim);
  }



  template <int dim>
  void
  Reaction<dim>::list_quantities(const std::string &name, Quantities &row) const
  {
    const std::string first    = name + ' ';
    const double      per_time = (duration > 0 ? 1. / duration : 0.);
    append_vector<dim>(row, first + "force", "N", per_time * impulse);
    append_vector<dim>(row,
                       first + "friction force",
                       "N",
                       per_time * tangential);
    append_vector<dim>(row, first + "least force", "N", least);
    append_vector<dim>(row, first + "largest force", "N", largest);
    append_vector<dim>(row, first + "least mean force", "N", least_mean);
    append_vector<dim>(row, first + "largest mean force", "N", largest_mean);
    for (unsigned int i = 0; i < angular_impulse.size(); ++i)
      row.push_back({first + "moment " + (dim == 2 ? 'z' : "xyz"[i]),
                     "N m",
                     per_time * angular_impulse[i]});
    row.push_back(
      {first + "contact area", dim == 2 ? "m" : "m^2", per_time * area_time});
    append_vector<dim>(row, first + "impulse", "N s", total.impulse);
    row.push_back({first + "friction work", "J", total.friction_work});
    row.push_back({first + "contact work", "J", total.contact_work});
  }



  // In one message for all of them.
  template <int dim>
  void
  add_to_reactions(std::vector<StepReaction<dim>> &steps,
                   const double                    dt,
                   const double                    averaging_time,
                   const MPI_Comm                  communicator,
                   std::vector<Reaction<dim>>     &reactions)
  {
    AssertDimension(steps.size(), reactions.size());
    std::vector<double> sums;
    for (const StepReaction<dim> &step : steps)
      {
        const auto values = step.as_list();
        sums.insert(sums.end(), values.begin(), values.end());
      }
    Utilities::MPI::sum(sums, communicator, sums);
    for (unsigned int k = 0; k < steps.size(); ++k)
      {
        steps[k].from_list(sums.data() + k * StepReaction<dim>::n_values);
        reactions[k].add(steps[k], dt, averaging_time);
      }
  }



  template struct Reaction<2>;
  template struct Reaction<3>;
  template decltype(add_to_reactions<2>) add_to_reactions<2>;
  template decltype(add_to_reactions<3>) add_to_reactions<3>;
} // namespace talus

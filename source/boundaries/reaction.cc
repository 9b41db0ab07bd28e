// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/reaction.h>

#include <talus/base/assertion.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Reaction<dim>::add(const StepReaction<dim> &step)
  {
    last = step;
    total += step;
    total.area = step.area;
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
  }



  // All reactions share one message.
  template <int dim>
  void
  add_to_reactions(std::vector<StepReaction<dim>> &steps,
                   const MPI_Comm                  communicator,
                   std::vector<Reaction<dim>>     &reactions)
  {
    TalusAssert(steps.size() == reactions.size(),
                dealii::ExcDimensionMismatch(steps.size(), reactions.size()));
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
        reactions[k].add(steps[k]);
      }
  }



  template struct Reaction<2>;
  template struct Reaction<3>;
  template decltype(add_to_reactions<2>) add_to_reactions<2>;
  template decltype(add_to_reactions<3>) add_to_reactions<3>;
} // namespace talus

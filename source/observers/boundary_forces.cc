// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/boundary_forces.h>

namespace talus
{
  template <int dim>
  BoundaryForces<dim>::BoundaryForces(BoundaryReactions<dim> &reactions)
    : TableObserver<dim>("boundaries.csv")
    , reactions_(reactions)
  {}



  template <int dim>
  bool
  BoundaryForces<dim>::is_enabled(const OutputSettings & /*settings*/) const
  {
    return reactions_.is_enabled();
  }



  /// In the order of the columns.
  template <int dim>
  Quantities
  BoundaryForces<dim>::evaluate(const double time) const
  {
    Quantities row = {{"time", "s", time}};
    reactions_.list_quantities(row);
    return row;
  }



  template <int dim>
  std::vector<std::string>
  BoundaryForces<dim>::columns(const OutputSettings & /*settings*/,
                               const State<dim> &state) const
  {
    std::vector<std::string> result;
    for (const Quantity &quantity : evaluate(state.time))
      result.push_back(quantity.heading());
    return result;
  }



  template <int dim>
  void
  BoundaryForces<dim>::observe(const State<dim> &state)
  {
    std::vector<double> values;
    for (const Quantity &quantity : evaluate(state.time))
      values.push_back(quantity.value);
    this->add_rows(state, {values});
    reactions_.start_interval();
  }



  template <int dim>
  void
  BoundaryForces<dim>::list_state(StateList &list)
  {
    if (reactions_.is_enabled())
      TableObserver<dim>::list_state(list);
  }



  template class BoundaryForces<2>;
  template class BoundaryForces<3>;
} // namespace talus

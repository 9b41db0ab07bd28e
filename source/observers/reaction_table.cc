// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/reaction_table.h>

namespace talus
{
  template <int dim>
  void
  ReactionTable<dim>::begin(const OutputSettings &settings,
                            const State<dim>     &state,
                            const Beginning       beginning)
  {
    averaging_time_ = settings.averaging_time;
    intervals_.resize(reactions().size());
    QuantityTable<dim>::begin(settings, state, beginning);
  }



  template <int dim>
  void
  ReactionTable<dim>::follow(const State<dim> &state)
  {
    for (unsigned int k = 0; k < intervals_.size(); ++k)
      intervals_[k].add(reactions()[k].last, state.time_step, averaging_time_);
  }



  template <int dim>
  void
  ReactionTable<dim>::observe(const State<dim> &state)
  {
    QuantityTable<dim>::observe(state);
    for (ReactionInterval<dim> &interval : intervals_)
      interval.restart();
  }



  template <int dim>
  void
  ReactionTable<dim>::list_reaction(const unsigned int k, Quantities &row) const
  {
    intervals_[k].list_quantities(name(k), reactions()[k].total, row);
  }



  // A checkpoint is loaded before begin().
  template <int dim>
  void
  ReactionTable<dim>::list_state(StateList &list)
  {
    if (reactions().empty())
      return;
    intervals_.resize(reactions().size());
    for (unsigned int k = 0; k < intervals_.size(); ++k)
      intervals_[k].list_state(kind() + ' ' + name(k), list);
    QuantityTable<dim>::list_state(list);
  }



  template class ReactionTable<2>;
  template class ReactionTable<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/reaction_table.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  ReactionInterval<dim>::add(const StepReaction<dim> &step,
                             const double             dt,
                             const double             averaging_time)
  {
    update_extremes(step.impulse / dt, dt, averaging_time);
    impulse_ += step.impulse;
    tangential_ += step.tangential;
    for (unsigned int i = 0; i < angular_impulse_.size(); ++i)
      angular_impulse_[i] += step.angular_impulse[i];
    area_time_ += dt * step.area;
    duration_ += dt;
  }



  // The mean decays exactly while the force of a step acts: the division of a
  // time with constant force into steps has no influence.
  template <int dim>
  void
  ReactionInterval<dim>::update_extremes(const Tensor<1, dim> &force,
                                         const double          dt,
                                         const double          averaging_time)
  {
    const double weight = has_running_mean_ && averaging_time > 0
                            ? -std::expm1(-dt / averaging_time)
                            : 1.;
    running_mean_ += weight * (force - running_mean_);
    has_running_mean_ = true;
    if (duration_ == 0)
      {
        min_ = max_ = force;
        min_mean_ = max_mean_ = running_mean_;
      }
    for (unsigned int d = 0; d < dim; ++d)
      {
        min_[d]      = std::min(min_[d], force[d]);
        max_[d]      = std::max(max_[d], force[d]);
        min_mean_[d] = std::min(min_mean_[d], running_mean_[d]);
        max_mean_[d] = std::max(max_mean_[d], running_mean_[d]);
      }
  }



  template <int dim>
  void
  ReactionInterval<dim>::list_state(const std::string &name, StateList &list)
  {
    const auto components = [&](const std::string &what,
                                const std::string &unit,
                                auto              &values,
                                const unsigned int n) {
      list.add_components(name + " " + what, unit, values, n, Reduction::equal);
    };
    list.add(name + " interval", "s", duration_, Reduction::equal);
    components("impulse of interval", "N s", impulse_, dim);
    components("friction impulse of interval", "N s", tangential_, dim);
    components("angular impulse of interval",
               "N m s",
               angular_impulse_,
               angular_impulse_.size());
    list.add(name + " area by time", "", area_time_, Reduction::equal);
    components("least force", "N", min_, dim);
    components("largest force", "N", max_, dim);
    components("running mean of the force", "N", running_mean_, dim);
    list.add(name + " has a running mean",
             "-",
             has_running_mean_,
             Reduction::equal);
    components("least mean force", "N", min_mean_, dim);
    components("largest mean force", "N", max_mean_, dim);
  }



  template <int dim>
  void
  ReactionInterval<dim>::list_quantities(const std::string       &name,
                                         const StepReaction<dim> &total,
                                         Quantities              &row) const
  {
    const std::string first    = name + ' ';
    const double      per_time = (duration_ > 0 ? 1. / duration_ : 0.);
    append_vector<dim>(row, first + "force", "N", per_time * impulse_);
    append_vector<dim>(row,
                       first + "friction force",
                       "N",
                       per_time * tangential_);
    append_vector<dim>(row, first + "least force", "N", min_);
    append_vector<dim>(row, first + "largest force", "N", max_);
    append_vector<dim>(row, first + "least mean force", "N", min_mean_);
    append_vector<dim>(row, first + "largest mean force", "N", max_mean_);
    for (unsigned int i = 0; i < angular_impulse_.size(); ++i)
      row.push_back({first + "moment " + (dim == 2 ? 'z' : "xyz"[i]),
                     "N m",
                     per_time * angular_impulse_[i]});
    row.push_back(
      {first + "contact area", dim == 2 ? "m" : "m^2", per_time * area_time_});
    append_vector<dim>(row, first + "impulse", "N s", total.impulse);
    row.push_back({first + "friction work", "J", total.friction_work});
    row.push_back({first + "contact work", "J", total.contact_work});
  }



  template class ReactionInterval<2>;
  template class ReactionInterval<3>;
} // namespace talus

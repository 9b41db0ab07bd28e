// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/fracture.h>
#include <talus/observers/point_motion.h>
#include <talus/observers/statistics.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <string>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Impulse of the seabed on the soil since the start of the run, N s.
    /// Collective.
    template <int dim>
    Tensor<1, dim>
    impulse(const State<dim> &state)
    {
      return Utilities::MPI::sum(state.accounts.impulse("seabed impulse"),
                                 state.communicator());
    }
  } // namespace



  template <int dim>
  void
  SeabedForce<dim>::restart(const State<dim> &state)
  {
    previous_time_    = state.time;
    previous_impulse_ = impulse(state);
  }



  /// The mean force is the impulse divided by the interval: the force of a
  /// single step jumps with every node that touches the seabed or leaves it,
  /// the impulse does not.
  template <int dim>
  void
  SeabedForce<dim>::list_quantities(const State<dim> &state,
                                    Quantities       &list) const
  {
    const Tensor<1, dim> now      = impulse(state);
    const double         interval = state.time - previous_time_;
    append_vector<dim>(list,
                       "seabed force",
                       "N",
                       interval > 0 ? (now - previous_impulse_) / interval
                                    : Tensor<1, dim>());
    append_vector<dim>(list, "seabed impulse", "N s", now);
  }



  /// With these values, the first row after a restart has the mean of the whole
  /// interval.
  template <int dim>
  void
  SeabedForce<dim>::list_state(StateList &list)
  {
    list.add("time of the last row", "s", previous_time_, Reduction::equal);
    list.add_components("seabed impulse at the last row",
                        "N s",
                        previous_impulse_,
                        dim,
                        Reduction::equal);
  }



  template class SeabedForce<2>;
  template class SeabedForce<3>;



  namespace
  {
    /// Kinetic energy of the points of this rank, J, from their half-step
    /// velocities.
    template <int dim>
    double
    kinetic_energy(const Points<dim> &points)
    {
      const double *mass   = points.data(points.mass);
      double        energy = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *v = points.data(points.velocity, d);
          for (unsigned int p = 0; p < points.size(); ++p)
            energy += 0.5 * mass[p] * v[p] * v[p];
        }
      return energy;
    }



    /// Sum of a column over the points of this rank.
    template <int dim>
    double
    total(const Points<dim> &points, const unsigned int column)
    {
      const double *values = points.data(column);
      return std::accumulate(values, values + points.size(), 0.);
    }



    struct Term
    {
      std::string name;
      int         sign; ///< in the remainder; 0: not in the budget
      double      value;
    };



    /// Terms over all ranks, in the order of their columns. Collective.
    template <int dim>
    std::vector<Term>
    sum_terms(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      std::vector<Term>  terms  = {
          {"kinetic energy", -1, kinetic_energy(points)},
          {"grid kinetic energy", 0, state.nodes.kinetic_energy()},
          {"elastic energy", -1, total(points, points.elastic_energy)},
          {"plastic work", -1, total(points, points.plastic_work)}};
      using Kind = typename Accounts<dim>::EnergyKind;
      for (const auto &energy : state.accounts.energies())
        terms.push_back(
          {energy.name,
           energy.kind == Kind::supplied ? 1 : -1,
           energy.kind == Kind::stored ? energy.stored(points) : energy.value});
      for (Term &term : terms)
        term.value = Utilities::MPI::sum(term.value, state.communicator());
      return terms;
    }
  } // namespace



  /// A run may begin with energy from an initial velocity, K0 stress or the
  /// static stages. Only changes after the beginning can balance.
  template <int dim>
  void
  EnergyBudget<dim>::begin(const State<dim> &state)
  {
    start_.clear();
    for (const Term &term : sum_terms(state))
      start_.push_back(term.value);
  }



  template <int dim>
  Quantities
  EnergyBudget<dim>::evaluate(const State<dim> &state) const
  {
    Quantities          result;
    std::vector<double> to_subtract;
    double              remainder = 0;
    for (const Term &term : sum_terms(state))
      {
        const unsigned int i = result.size();
        const double change = term.value - (i < start_.size() ? start_[i] : 0.);
        result.push_back({term.name, "J", term.value});
        if (term.sign > 0)
          remainder += change;
        else if (term.sign < 0)
          to_subtract.push_back(change);
      }
    for (const double change : to_subtract)
      remainder -= change;
    result.push_back({"energy remainder", "J", remainder});
    return result;
  }



  // The sums are identical on all ranks. A resumed run, in which begin() is not
  // called, saves the sums, too.
  template <int dim>
  void
  EnergyBudget<dim>::list_state(StateList &list)
  {
    list.add_table({"energies at the start",
                    "energy [J], by term of the energy budget",
                    1,
                    [this]() { return start_; },
                    [this](const std::vector<double> &rows) { start_ = rows; },
                    /*is_common=*/true});
  }



  template class EnergyBudget<2>;
  template class EnergyBudget<3>;



  /// Names and values come from the same list, so header and rows cannot
  /// differ. doc/output.md describes the columns.
  template <int dim>
  Quantities
  Statistics<dim>::evaluate(const State<dim> &state,
                            const bool        with_runout) const
  {
    Quantities        row = {{"time", "s", state.time},
                             {"step", "", static_cast<double>(state.step)},
                             {"time step", "s", state.time_step}};
    const Ground<dim> ground(state.grid.domain(), obstacles_);
    list_motion(state, ground, with_runout, row);
    if (with_runout && thick_soil_)
      thick_soil_(state, row);
    seabed_force_.list_quantities(state, row);
    const Quantities energies = budget_.evaluate(state);
    row.insert(row.end(), energies.begin(), energies.end());
    list_fractures(state, ground, row);
    for (const Source &source : sources_)
      source(state, row);
    return row;
  }



  /// The next mean of the seabed force begins at each row.
  template <int dim>
  void
  Statistics<dim>::observe(const State<dim> &state)
  {
    std::vector<double> values;
    for (const Quantity &quantity : evaluate(state, has_runout_))
      values.push_back(quantity.value);
    this->add_rows(state, {values});
    seabed_force_.restart(state);
  }



  template class Statistics<2>;
  template class Statistics<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/energy_budget.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <numeric>
#include <string>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Of this rank's points, J, with the velocities as they are, those of the
    /// half step.
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



    /// Of the water that moves with this rank's points, J.
    template <int dim>
    double
    kinetic_energy_of_added_mass(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      double             energy = 0;
      if (!state.added_mass.empty())
        for (unsigned int p = 0; p < points.size(); ++p)
          energy += 0.5 * points.data(points.mass)[p] *
                    state.added_mass[points.data(points.body)[p]] *
                    load_place(points, points.velocity, p).norm_square();
      return energy;
    }



    /// Sum of a column over this rank's points.
    template <int dim>
    double
    total(const Points<dim> &points, const unsigned int column)
    {
      const double *values = points.data(column);
      return std::accumulate(values, values + points.size(), 0.);
    }



    /// What must be there for a term to have a column.
    enum class Needs
    {
      nothing,
      water,
      merging,
      outflow
    };



    // A term and its name: columns of statistics.csv, sums over ranks and state
    // of a checkpoint go through the same list, so that none of them can forget
    // one.
    struct Term
    {
      const char *name;
      double EnergyTerms::*value;
      Needs                needs = Needs::nothing;
    };

    /// The terms but for what they leave, in the order of their columns.
    constexpr std::array<Term, 12> terms = {
      {{"kinetic energy", &EnergyTerms::kinetic},
       {"grid kinetic energy", &EnergyTerms::grid_kinetic},
       {"elastic energy", &EnergyTerms::elastic},
       {"plastic work", &EnergyTerms::plastic},
       {"friction work", &EnergyTerms::friction},
       {"contact work", &EnergyTerms::contact},
       {"damping work", &EnergyTerms::damping},
       {"gravity work", &EnergyTerms::gravity},
       {"drag work", &EnergyTerms::drag, Needs::water},
       {"added mass kinetic energy", &EnergyTerms::added, Needs::water},
       {"merging work", &EnergyTerms::merging, Needs::merging},
       {"outflow energy", &EnergyTerms::outflow, Needs::outflow}}};



    template <int dim>
    bool
    has_column(const Term &term, const State<dim> &state)
    {
      return term.needs == Needs::water     ? !state.added_mass.empty()
             : term.needs == Needs::merging ? state.may_merge
             : term.needs == Needs::outflow ? state.outflow.is_open()
                                            : true;
    }



    /// All terms but the remainder, over all ranks. Points carry their elastic
    /// energy and plastic work themselves; what boundaries, damping and gravity
    /// did is in the works of the state, each rank's share. Collective.
    template <int dim>
    EnergyTerms
    sum_terms(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      EnergyTerms        result;
      result.kinetic      = kinetic_energy(points);
      result.grid_kinetic = state.nodes.kinetic_energy();
      result.elastic      = total(points, points.elastic_energy);
      result.plastic      = total(points, points.plastic_work);
      result.friction     = state.works.friction;
      result.contact      = state.works.contact;
      result.damping      = state.works.damping;
      result.gravity      = state.works.gravity;
      result.drag         = state.works.drag;
      result.merging      = state.works.merging;
      result.outflow      = state.outflow.energy();
      result.added        = kinetic_energy_of_added_mass(state);
      for (const Term &term : terms)
        result.*term.value =
          Utilities::MPI::sum(result.*term.value, state.communicator());
      return result;
    }
  } // namespace



  /// The run may begin with energy: of an initial velocity, of K0 stress, or
  /// what the static stages left. Only changes since then can balance.
  template <int dim>
  void
  EnergyBudget<dim>::begin(const State<dim> &state)
  {
    start_ = sum_terms(state);
  }



  /// The grid's kinetic energy is no part of the balance: it is the same motion
  /// seen from the nodes, and smaller by what FLIP keeps at the points. A
  /// remainder is therefore what the transfer dissipates (doc/method.md,
  /// section 7), and a negative one would be energy made from nothing.
  template <int dim>
  EnergyTerms
  EnergyBudget<dim>::evaluate(const State<dim> &state) const
  {
    EnergyTerms now = sum_terms(state);
    now.remainder =
      (now.gravity - start_.gravity) - (now.kinetic - start_.kinetic) -
      (now.elastic - start_.elastic) - (now.plastic - start_.plastic) -
      (now.friction - start_.friction) - (now.contact - start_.contact) -
      (now.damping - start_.damping) - (now.drag - start_.drag) -
      (now.added - start_.added) - now.merging - now.outflow;
    return now;
  }



  template <int dim>
  void
  EnergyBudget<dim>::list_quantities(const State<dim> &state,
                                     Quantities       &list) const
  {
    const EnergyTerms now = evaluate(state);
    for (const Term &term : terms)
      if (has_column(term, state))
        list.push_back({term.name, "J", now.*term.value});
    list.push_back({"energy remainder", "J", now.remainder});
  }



  /// All ranks have the same sums, so a checkpoint may be read by other numbers
  /// of ranks.
  template <int dim>
  void
  EnergyBudget<dim>::list_state(StateList &list)
  {
    for (const Term &term : terms)
      // Nothing is merged, and nothing leaves, before the start.
      if (term.needs != Needs::merging && term.needs != Needs::outflow)
        list.add(std::string(term.name) + " at the start",
                 "J",
                 start_.*term.value,
                 Reduction::equal);
  }



  template class EnergyBudget<2>;
  template class EnergyBudget<3>;
} // namespace talus

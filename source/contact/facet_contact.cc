// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/contact/facet_contact.h>
#include <talus/contact/impulse_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Sweeps in the first step of a run, which has no impulses to start from.
    constexpr unsigned int n_first_sweeps = 50;

    // Sweeps in all later steps. Facets of an obstacle that moves through the
    // mesh enter new cells and begin without an impulse there: with one sweep
    // the force on a dragged pipe would be 3 to 5 % too small. More than four
    // sweeps do not change the force.
    constexpr unsigned int n_sweeps_at_rest = 1, n_sweeps_moving = 4;
  } // namespace



  template <int dim>
  FacetContact<dim>::FacetContact(Obstacles<dim>  &obstacles,
                                  Boundaries<dim> &boundaries)
    : obstacles_(obstacles)
    , boundaries_(boundaries)
    , reactions_(obstacles.size())
  {
    boundaries_.set_covered_area(
      [this](const unsigned int face, const unsigned int node) {
        return soil_.at_faces().area(face, node);
      });
  }



  template <int dim>
  void
  FacetContact<dim>::prepare(const Grid<dim> &grid)
  {
    if (obstacles_.empty())
      return soil_.prepare(grid, boundaries_.seabed_faces());
    obstacles_.locate(); // a checkpoint may have restored their places
    facets_.prepare(grid, obstacles_);
    impulses_.move_to(keys_of(facets_.owned()), grid.communicator());
    if (keeps_slip())
      slip_.prepare(places_of_facets(), grid.communicator());
    nodes_.prepare(grid);
    soil_.prepare(grid, boundaries_.seabed_faces());
    constraints_.prepare();
  }



  template <int dim>
  std::vector<BedPlace<dim>>
  FacetContact<dim>::places_of_facets() const
  {
    std::vector<BedPlace<dim>> result;
    for (const ContactFacet<dim> &facet : facets_.owned())
      result.push_back({key_of(facet), facet.centroid, facet.area});
    return result;
  }



  /// Give impulses and slip to the present facets of this rank.
  template <int dim>
  void
  FacetContact<dim>::update_places()
  {
    impulses_.update(keys_of(facets_.owned()));
    if (keeps_slip())
      slip_.update(places_of_facets());
  }



  /// Add the slip of the step at the facets with friction at the limit. Facets
  /// that stick move a little against their neighbours, as the iteration ends
  /// after one sweep: such motion is no slip. Obstacles that soften are at
  /// rest.
  template <int dim>
  void
  FacetContact<dim>::add_slip(const State<dim> &state)
  {
    const double dt = state.time_step;
    for (const unsigned int c : constraints_.loaded())
      {
        const ContactFacet<dim> &facet   = facets_.owned()[c];
        const FacetImpulse<dim> &impulse = impulses_[c];
        if (!obstacles_[facet.obstacle].bed().softens() ||
            constraints_[c].normal_mass == 0)
          continue;
        const double limit =
          constraints_.friction_limit(c, impulse.mean_normal, dt);
        if (!(limit > 0) || impulse.tangential.norm() < (1. - 1e-9) * limit)
          continue;
        const Tensor<1, dim> u   = constraints_.velocity(c);
        const Tensor<1, dim> u_t = u - (u * facet.normal) * facet.normal;
        slip_.add(c, u_t.norm() * dt);
      }
  }



  // Jacobi's iteration with mass splitting: all facets see the same velocities,
  // and the facets of a node share the mass of the node. So all facets together
  // cannot push a node farther than a single facet. One sweep per step is
  // enough, because the iteration starts from the previous impulses. Neither
  // the order of the facets nor the number of ranks matters. Walls come first:
  // no facet can change a component held by a wall.
  template <int dim>
  void
  FacetContact<dim>::correct_velocities(State<dim> &state)
  {
    if (obstacles_.empty())
      return;
    slip_.begin_step(state.communicator());
    nodes_.hold_walls(state, boundaries_);
    find_constraints(state);
    bodies_.begin_step(state);
    warm_start(state);
    const unsigned int n_sweeps = (!has_begun_         ? n_first_sweeps
                                   : obstacles_.move() ? n_sweeps_moving
                                                       : n_sweeps_at_rest);
    for (unsigned int s = 0; s < n_sweeps; ++s)
      sweep(state);
    for (const unsigned int c : constraints_.loaded())
      impulses_[c].mean_normal =
        mean_normal(impulses_[c], constraints_[c], impulses_[c].normal);
    if (obstacles_.soften())
      add_slip(state);
    has_begun_          = true;
    previous_time_step_ = state.time_step;
    nodes_.write(state);
    hold_nodes_inside(state);
  }



  template <int dim>
  void
  FacetContact<dim>::find_constraints(const State<dim> &state)
  {
    nodes_.load(state);
    constraints_.find(state, /*has_memory=*/has_begun_);
  }



  // A force is an impulse of 1 s; the first step scales the impulse to the time
  // step, as warm_start() does in every step.
  template <int dim>
  void
  FacetContact<dim>::set_forces(const std::vector<FacetImpulse<dim>> &forces)
  {
    TalusAssert(forces.size() == impulses_.size(),
                ExcDimensionMismatch(forces.size(), impulses_.size()));
    std::copy(forces.begin(), forces.end(), impulses_.begin());
    previous_time_step_ = 1.;
    has_begun_          = true;
  }



  // Obstacles may have moved since the start over cells that Facets::update()
  // does not cut again: all cells are cut.
  /// Give the impulses of a checkpoint to the facets, as soon as facets exist.
  template <int dim>
  void
  FacetContact<dim>::take_restored(const State<dim> &state)
  {
    if (!impulses_.is_waiting())
      return;
    if (obstacles_.move())
      {
        obstacles_.locate();
        facets_.prepare(state.grid, obstacles_);
      }
    update_places();
  }



  /// Impulses stay with their cells when obstacles move.
  template <int dim>
  void
  FacetContact<dim>::begin_step(State<dim> &state)
  {
    take_restored(state);
    if (obstacles_.move())
      {
        obstacles_.advance(state.time, state.time_step);
        facets_.update(state.grid, obstacles_);
        update_places();
      }
    soil_.find(state);
  }



  /// Distribute the impulse of a facet, N s, to the nodes of the facet.
  template <int dim>
  void
  FacetContact<dim>::add_impulse(const unsigned int    facet,
                                 const Tensor<1, dim> &impulse)
  {
    const auto &node = facets_.owned()[facet].node;
    for (unsigned int v = 0; v < node.size(); ++v)
      nodes_.add_impulse(node[v], constraints_[facet].share[v] * impulse);
  }



  // Start from the previous impulses, reduced in proportion where the effective
  // mass has decreased: where soil becomes thin, full impulses would throw the
  // remaining light nodes.
  template <int dim>
  void
  FacetContact<dim>::warm_start(const State<dim> &state)
  {
    const double longer =
      (previous_time_step_ > 0 ? state.time_step / previous_time_step_ : 1.);
    for (unsigned int c = 0; c < facets_.owned().size(); ++c)
      {
        const FacetConstraint<dim> &constraint = constraints_[c];
        FacetImpulse<dim>          &impulse    = impulses_[c];
        if (!constraint.is_loaded || constraint.gap > 0 ||
            constraint.normal_mass == 0 || impulse.effective_mass == 0)
          {
            impulse = {0, {}, constraint.is_loaded ? constraint.mass : 0};
            continue;
          }
        const double factor =
          longer * std::min(1., constraint.mass / impulse.effective_mass);
        impulse.normal *= factor;
        impulse.mean_normal *= longer;
        impulse.tangential = factor * impulse.tangential;
        impulse.tangential =
          cut_to_length(impulse.tangential,
                        constraints_.friction_impulse(c,
                                                      impulse.tangential.norm(),
                                                      impulse.mean_normal,
                                                      state.time_step));
        impulse.effective_mass = constraint.mass;
        add_impulse(c,
                    impulse.normal * facets_.owned()[c].normal +
                      impulse.tangential);
      }
    nodes_.update_velocities();
  }



  // Bodies with a mass get the velocities with which their momenta balance the
  // impulses of this sweep.
  template <int dim>
  void
  FacetContact<dim>::sweep(const State<dim> &state)
  {
    const double dt = state.time_step;
    bodies_.update_velocities(state);
    for (const unsigned int c : constraints_.loaded())
      {
        if (constraints_[c].normal_mass == 0)
          continue;
        const ContactFacet<dim> &facet   = facets_.owned()[c];
        FacetImpulse<dim>       &impulse = impulses_[c];
        const Tensor<1, dim>     of_obstacle =
          obstacles_[facet.obstacle].velocity_at(facet.centroid,
                                                 state.time + 0.5 * dt);
        const auto projected =
          projected_impulse(constraints_,
                            c,
                            facet,
                            impulse,
                            constraints_.velocity(c) - of_obstacle,
                            dt);
        add_impulse(c,
                    (projected.normal - impulse.normal) * facet.normal +
                      projected.tangential - impulse.tangential);
        impulse.normal     = projected.normal;
        impulse.tangential = projected.tangential;
      }
    nodes_.update_velocities();
  }



  // Soil that dips below the surface reaches nodes that touch no facet. These
  // nodes carry less than a thousandth of the force, but would fall without a
  // rule. The nodes have no area in contact, hence no friction.
  template <int dim>
  void
  FacetContact<dim>::hold_nodes_inside(State<dim> &state)
  {
    impulses_inside_.clear();
    const double dt = state.time_step;
    for (const auto &inside : facets_.nodes_inside())
      {
        const double mass = state.nodes.mass(inside.node);
        if (mass <= state.constants.mass_cutoff)
          continue;
        const Obstacle<dim> &obstacle = obstacles_[inside.obstacle];
        const Tensor<1, dim> n        = obstacle.normal(inside.place);
        const double         may_move =
          -constraints_.gap_inside(state.grid, inside) / dt;
        const Tensor<1, dim> v = state.nodes.velocity(inside.node);
        const double         v_n =
          (v - obstacle.velocity_at(inside.place, state.time + 0.5 * dt)) * n;
        if (v_n < may_move)
          impulses_inside_.push_back(
            {inside.node,
             inside.obstacle,
             inside.place,
             state.nodes.set_velocity(inside.node, v + (may_move - v_n) * n)});
      }
  }



  /// Add the impulses and works of the facets of this rank to @p steps, one
  /// entry per obstacle.
  template <int dim>
  void
  FacetContact<dim>::record_facets(const State<dim>               &state,
                                   std::vector<StepReaction<dim>> &steps) const
  {
    for (const unsigned int c : constraints_.loaded())
      {
        const FacetImpulse<dim> &impulse = impulses_[c];
        if (!impulse.acts())
          continue;
        const ContactFacet<dim>    &facet      = facets_.owned()[c];
        const FacetConstraint<dim> &constraint = constraints_[c];
        StepReaction<dim>          &step       = steps[facet.obstacle];
        Tensor<1, dim>              v;
        for (unsigned int i = 0; i < facet.node.size(); ++i)
          v += constraint.share[i] * state.nodes.mean_velocity(facet.node[i]);
        const Tensor<1, dim> normal = impulse.normal * facet.normal;
        step.add_impulse_on_soil(facet.centroid -
                                   obstacles_[facet.obstacle].reference_point(),
                                 normal + impulse.tangential);
        step.tangential -= impulse.tangential;
        step.area += constraint.area;
        step.friction_work -= impulse.tangential * v;
        step.contact_work -= normal * v;
      }
    for (const ImpulseInside &inside : impulses_inside_)
      {
        StepReaction<dim> &step = steps[inside.obstacle];
        step.add_impulse_on_soil(
          inside.place - obstacles_[inside.obstacle].reference_point(),
          inside.impulse);
        step.contact_work -=
          inside.impulse * state.nodes.mean_velocity(inside.node);
      }
  }



  // The work of an impulse is the product with the mean of the velocities
  // before and after the step, when all conditions have acted: only these works
  // balance the change of kinetic energy.
  template <int dim>
  void
  FacetContact<dim>::record(State<dim> &state)
  {
    if (obstacles_.empty())
      return;
    nodes_.record_walls(state, boundaries_);
    std::vector<StepReaction<dim>> steps(obstacles_.size());
    record_facets(state, steps);
    for (const StepReaction<dim> &step : steps)
      {
        state.accounts.energy("friction work") += step.friction_work;
        state.accounts.energy("contact work") += step.contact_work;
      }
    add_to_reactions(steps, state.communicator(), reactions_);
    bodies_.end_step(reactions_, state);
  }



  template <int dim>
  void
  FacetContact<dim>::list_quantities(const State<dim> &state,
                                     Quantities       &list) const
  {
    if (obstacles_.soften())
      append_slip("obstacles", slip_, state.communicator(), list);
  }



  template <int dim>
  void
  FacetContact<dim>::list_state(StateList &list)
  {
    if (obstacles_.empty())
      return;
    list.add("contact has begun", "-", has_begun_, Reduction::equal);
    list.add("time step of the contact",
             "s",
             previous_time_step_,
             Reduction::equal);
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      reactions_[k].list_state("obstacle " + obstacles_[k].name(), list);
    impulses_.list_state("facet impulses", list);
    if (obstacles_.soften())
      slip_.list_state("slip of obstacles", list);
  }



  template class FacetContact<2>;
  template class FacetContact<3>;
} // namespace talus

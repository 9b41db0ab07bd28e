// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/contact/contact.h>
#include <talus/contact/impulse_projection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

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
  Contact<dim>::Contact(Obstacles<dim> &obstacles, Boundaries<dim> &boundaries)
    : obstacles_(obstacles)
    , boundaries_(boundaries)
    , reactions_(obstacles.size())
  {}



  template <int dim>
  void
  Contact<dim>::prepare(const Grid<dim> &grid)
  {
    if (!obstacles_.empty())
      {
        obstacles_.locate(); // a checkpoint may have restored their places
        facets_.prepare(grid, obstacles_);
        nodes_.prepare(grid);
      }
    face_nodes_.prepare(grid);
    impulses_.move_to(keys(), grid.communicator());
    if (keeps_slip())
      slip_.prepare(places(), grid.communicator());
    soil_.prepare(grid,
                  boundaries_.seabed_faces(),
                  boundaries_.seabed().has_gap());
    constraints_.prepare();
  }



  template <int dim>
  std::vector<PlaceKey>
  Contact<dim>::keys() const
  {
    std::vector<PlaceKey> result = keys_of(facets_.owned());
    for (const FaceNode<dim> &at : face_nodes_.all())
      result.push_back(at.key);
    return result;
  }



  template <int dim>
  std::vector<BedPlace<dim>>
  Contact<dim>::places() const
  {
    std::vector<BedPlace<dim>> result;
    for (const ContactFacet<dim> &facet : facets_.owned())
      result.push_back({key_of(facet), facet.centroid, facet.area});
    for (const FaceNode<dim> &at : face_nodes_.all())
      result.push_back({at.key, at.x, at.area});
    return result;
  }



  /// Give impulses and slip to the present places of this rank.
  template <int dim>
  void
  Contact<dim>::update_places()
  {
    // In most steps a moving obstacle cuts the cells of the step before.
    if (std::vector<PlaceKey> now = keys();
        impulses_.is_waiting() || now != impulses_.places())
      impulses_.update(std::move(now));
    if (keeps_slip())
      slip_.update(places());
  }



  /// Add the slip of the step at the facets with friction at the limit. Facets
  /// that stick move a little against their neighbours, as the iteration ends
  /// after one sweep: such motion is no slip. Obstacles that soften are at
  /// rest.
  template <int dim>
  void
  Contact<dim>::add_slip(const State<dim> &state)
  {
    const double dt = state.time_step;
    for (const unsigned int c : constraints_.loaded())
      {
        const ContactFacet<dim>   &facet   = facets_.owned()[c];
        const ContactImpulse<dim> &impulse = impulses_[c];
        if (!obstacles_[facet.obstacle].bed().changes_by_slip() ||
            constraints_[c].normal_mass == 0)
          continue;
        const double limit =
          dt * constraints_.limit(c).force(impulse.mean_normal / dt);
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
  Contact<dim>::find_impulses_of_facets(State<dim> &state)
  {
    nodes_.hold_walls(state, boundaries_);
    nodes_.load(state);
    constraints_.find(state, has_begun_);
    bodies_.begin_step(state);
    warm_start(state);
    const unsigned int n_sweeps = (!has_begun_         ? n_first_sweeps
                                   : obstacles_.move() ? n_sweeps_moving
                                                       : n_sweeps_at_rest);
    for (unsigned int s = 1; s <= n_sweeps; ++s)
      sweep(state, s < n_sweeps || obstacles_.change_by_slip());
    for (const unsigned int c : constraints_.loaded())
      {
        ContactImpulse<dim> &impulse = impulses_[c];
        impulse.mean_normal =
          mean_normal(impulse, constraints_[c], impulse.normal);
        impulse.area = impulse.mean_normal > 0 ? constraints_[c].area : 0.;
      }
    if (obstacles_.change_by_slip())
      add_slip(state);
    nodes_.write(state);
    hold_nodes_inside(state);
  }



  // Seabeds come last: the projection at their nodes is exact, so that no soil
  // leaves the mesh whatever the obstacles do.
  template <int dim>
  void
  Contact<dim>::correct_velocities(State<dim> &state)
  {
    slip_.begin_step(state.communicator());
    constraints_.begin_step();
    if (!obstacles_.empty())
      find_impulses_of_facets(state);
    find_impulses_of_nodes(state);
    has_begun_          = true;
    previous_time_step_ = state.time_step;
  }



  template <int dim>
  void
  Contact<dim>::find_constraints(const State<dim> &state)
  {
    constraints_.begin_step();
    if (!obstacles_.empty())
      {
        nodes_.load(state);
        constraints_.find(state, has_begun_);
      }
    for (unsigned int i = 0; i < face_nodes_.size(); ++i)
      if (state.nodes.mass(face_nodes_[i].node) > state.constants.mass_cutoff)
        constraints_.find_at_node(state, i, has_begun_);
  }



  // A node with several seabed faces meets one after the other. Places without
  // soil in this step forget their impulse.
  template <int dim>
  void
  Contact<dim>::find_impulses_of_nodes(State<dim> &state)
  {
    if (face_nodes_.size() == 0)
      return;
    BoundaryWork<dim> of_walls;
    const double      longer =
      (previous_time_step_ > 0 ? state.time_step / previous_time_step_ : 1.);
    for (const unsigned int node : state.nodes.active_boundary_nodes())
      if (state.nodes.mass(node) > state.constants.mass_cutoff)
        face_nodes_.for_each_at(node, [&](const unsigned int i) {
          // Components held by a wall must not use up the friction.
          if (face_nodes_[i].walls != 0)
            boundaries_.impose_walls(state, node, of_walls);
          project_at_node(state, i, longer);
        });
    of_walls.record(state.accounts);
    for (unsigned int i = 0; i < face_nodes_.size(); ++i)
      if (const unsigned int c = constraints_.place_of_node(i);
          !constraints_[c].is_loaded && impulses_[c].effective_mass > 0)
        impulses_[c] = {};
  }



  // The trial velocity is the velocity after the momentum update and the
  // obstacles. The impact along the normal is plastic: the impulse stops the
  // node. Friction can at most stop the node, never drive the node back; at
  // rest friction bears the load, and no penalty stiffness limits the step.
  // Nothing pulls: soil can lift off.
  //
  // A shaking node would have no friction in every step in which the node moves
  // away, and a body at rest would creep: so friction follows the mean normal
  // force, also in these steps.
  /// Apply the contact at entry @p i of face_nodes(). @p longer: time step over
  /// the previous one [-].
  template <int dim>
  void
  Contact<dim>::project_at_node(State<dim>        &state,
                                const unsigned int i,
                                const double       longer)
  {
    const FaceNode<dim> &at      = face_nodes_[i];
    const Tensor<1, dim> normal  = at.normal();
    const Tensor<1, dim> u       = state.nodes.velocity(at.node);
    const double         dt      = state.time_step;
    const unsigned int   c       = constraints_.place_of_node(i);
    ContactImpulse<dim> &impulse = impulses_[c];
    if (const double gap = soil_.gap(at); gap > 0 && u * normal >= -gap / dt)
      return;
    constraints_.find_at_node(state, i, impulse.effective_mass > 0);
    const ContactConstraint<dim> &constraint = constraints_[c];
    impulse = {0., {}, constraint.mass, longer * impulse.mean_normal, 0.};
    const auto projected =
      projected_impulse(constraints_, c, normal, impulse, u, dt);
    impulse.mean_normal = mean_normal(impulse, constraint, projected.normal);
    impulse.normal      = projected.normal;
    impulse.tangential  = projected.tangential;
    impulse.area        = impulse.mean_normal > 0 ? constraint.area : 0.;
    state.nodes.set_velocity(at.node,
                             u +
                               (impulse.normal * normal + impulse.tangential) /
                                 constraint.mass);
    // Soil without friction remoulds nothing.
    if (projected.sticking < 1 && constraints_.bed(c).changes_by_slip() &&
        constraints_.limit(c).force(impulse.mean_normal) > 0)
      {
        const Tensor<1, dim> slip = dt * (u - (u * normal) * normal);
        slip_.add(c, (1. - projected.sticking) * slip.norm());
      }
  }



  // A force is an impulse of 1 s; the first step scales the impulse to the time
  // step, as warm_start() does in every step.
  template <int dim>
  void
  Contact<dim>::set_forces(const std::vector<ContactImpulse<dim>> &forces)
  {
    TalusAssert(forces.size() == facets_.owned().size(),
                ExcDimensionMismatch(forces.size(), facets_.owned().size()));
    std::copy(forces.begin(), forces.end(), impulses_.begin());
    previous_time_step_ = 1.;
    has_begun_          = true;
  }



  // Obstacles may have moved since the start over cells that Facets::update()
  // does not cut again: all cells are cut.
  /// Give the impulses of a checkpoint to the facets, as soon as facets exist.
  template <int dim>
  void
  Contact<dim>::take_restored(const State<dim> &state)
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
  Contact<dim>::begin_step(State<dim> &state)
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
  Contact<dim>::add_impulse(const unsigned int    facet,
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
  Contact<dim>::warm_start(const State<dim> &state)
  {
    const double longer =
      (previous_time_step_ > 0 ? state.time_step / previous_time_step_ : 1.);
    for (unsigned int c = 0; c < facets_.owned().size(); ++c)
      {
        const ContactConstraint<dim> &constraint = constraints_[c];
        ContactImpulse<dim>          &impulse    = impulses_[c];
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
  // impulses of this sweep. The last sweep needs no velocities at ghosts.
  template <int dim>
  void
  Contact<dim>::sweep(const State<dim> &state, const bool is_read_at_ghosts)
  {
    const double dt = state.time_step;
    bodies_.update_velocities(state);
    for (const unsigned int c : constraints_.loaded())
      {
        if (constraints_[c].normal_mass == 0)
          continue;
        const ContactFacet<dim> &facet   = facets_.owned()[c];
        ContactImpulse<dim>     &impulse = impulses_[c];
        const Tensor<1, dim>     of_obstacle =
          obstacles_[facet.obstacle].velocity_at(facet.centroid,
                                                 state.time + 0.5 * dt);
        const auto projected =
          projected_impulse(constraints_,
                            c,
                            facet.normal,
                            impulse,
                            constraints_.velocity(c) - of_obstacle,
                            dt);
        add_impulse(c,
                    (projected.normal - impulse.normal) * facet.normal +
                      projected.tangential - impulse.tangential);
        impulse.normal     = projected.normal;
        impulse.tangential = projected.tangential;
      }
    nodes_.update_velocities(is_read_at_ghosts);
  }



  // Soil that dips below the surface reaches nodes that touch no facet. These
  // nodes carry less than a thousandth of the force, but would fall without a
  // rule. The nodes have no area in contact, hence no friction.
  template <int dim>
  void
  Contact<dim>::hold_nodes_inside(State<dim> &state)
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



  /// Return impulses and works of this rank, one entry per obstacle.
  template <int dim>
  std::vector<StepReaction<dim>>
  Contact<dim>::reactions_of_obstacles(const State<dim> &state) const
  {
    std::vector<StepReaction<dim>> steps(obstacles_.size());
    for (const unsigned int c : constraints_.loaded())
      {
        const ContactImpulse<dim> &impulse = impulses_[c];
        if (!impulse.acts())
          continue;
        const ContactFacet<dim>      &facet      = facets_.owned()[c];
        const ContactConstraint<dim> &constraint = constraints_[c];
        StepReaction<dim>            &step       = steps[facet.obstacle];
        Tensor<1, dim>                v;
        for (unsigned int i = 0; i < facet.node.size(); ++i)
          v += constraint.share[i] * state.nodes.mean_velocity(facet.node[i]);
        step.add_contact(facet.centroid -
                           obstacles_[facet.obstacle].reference_point(),
                         impulse.normal * facet.normal,
                         impulse.tangential,
                         v);
        step.area += constraint.area;
      }
    for (const ImpulseInside &inside : impulses_inside_)
      steps[inside.obstacle].add_contact(
        inside.place - obstacles_[inside.obstacle].reference_point(),
        inside.impulse,
        Tensor<1, dim>(),
        state.nodes.mean_velocity(inside.node));
    return steps;
  }



  /// Record impulses and works at the nodes of seabed faces.
  template <int dim>
  void
  Contact<dim>::record_nodes(State<dim> &state)
  {
    StepReaction<dim> of_all;
    auto             &reactions = boundaries_.reactions();
    for (const unsigned int i : constraints_.loaded_nodes())
      {
        const FaceNode<dim>       &at      = face_nodes_[i];
        const unsigned int         c       = constraints_.place_of_node(i);
        const ContactImpulse<dim> &impulse = impulses_[c];
        if (!impulse.acts())
          continue;
        StepReaction<dim> step;
        step.add_contact(at.x,
                         impulse.normal * at.normal(),
                         impulse.tangential,
                         state.nodes.mean_velocity(at.node));
        step.area = constraints_[c].area;
        of_all += step;
        if (reactions.is_enabled())
          reactions.in_step(at.face) += step;
      }
    state.accounts.energy("friction work") += of_all.friction_work;
    state.accounts.energy("contact work") += of_all.contact_work;
    state.accounts.impulse("seabed impulse") -= of_all.impulse;
  }



  // The work of an impulse is the product with the mean of the velocities
  // before and after the step, when all conditions have acted: only these works
  // balance the change of kinetic energy.
  template <int dim>
  void
  Contact<dim>::record(State<dim> &state)
  {
    record_nodes(state);
    if (obstacles_.empty())
      return;
    nodes_.record_walls(state, boundaries_);
    std::vector<StepReaction<dim>> steps = reactions_of_obstacles(state);
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
  Contact<dim>::list_quantities(const State<dim> &state, Quantities &list) const
  {
    const bool on_seabed    = boundaries_.seabed().changes_by_slip();
    const bool on_obstacles = obstacles_.change_by_slip();
    if (!on_seabed && !on_obstacles)
      return;
    const unsigned int n      = 1 + obstacles_.size();
    const auto         areas  = slip_.slipped_areas(n, state.communicator());
    const auto         slips  = slip_.largest_slips(n, state.communicator());
    const auto         append = [&list](const std::string &surfaces,
                                const double       area,
                                const double       slip) {
      list.push_back({"slipped " + surfaces, dim == 2 ? "m" : "m^2", area});
      list.push_back({"largest slip of " + surfaces, "m", slip});
    };
    if (on_seabed)
      append("seabed", areas[0], slips[0]);
    if (on_obstacles)
      append("obstacles",
             std::accumulate(areas.begin() + 1, areas.end(), 0.),
             *std::max_element(slips.begin() + 1, slips.end()));
  }



  template <int dim>
  void
  Contact<dim>::list_state(StateList &list)
  {
    list.add("contact has begun", "-", has_begun_, Reduction::equal);
    list.add("time step of the contact",
             "s",
             previous_time_step_,
             Reduction::equal);
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      reactions_[k].list_state("obstacle " + obstacles_[k].name(), list);
    impulses_.list_state("impulses of contact", list);
    if (boundaries_.seabed().changes_by_slip() || obstacles_.change_by_slip())
      slip_.list_state("slip of beds", list);
  }



  template class Contact<2>;
  template class Contact<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/facet_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Sweeps of a run's first step, which has no impulses to start from.
    constexpr unsigned int n_first_sweeps = 50;

    // Of other steps. Facets of an obstacle that moves through the mesh come to
    // lie in cells where there was none before and begin without an impulse: the
    // force on a pipe that is dragged would be 3 to 5 % too small with one
    // sweep, and does not change with more than four.
    constexpr unsigned int n_sweeps_at_rest = 1, n_sweeps_moving = 4;

    // Of the memory of friction: it fades within so many steps, and within so much
    // of a cell of slip. On a block that rings (2600 steps a second, h/c 2.5 steps)
    // 8 are not enough, 16 to 64 do the same. Without the second, soil that slides
    // a quarter as fast as its waves would be gone before friction has felt it.
    constexpr double n_steps_of_memory = 32, slip_of_memory = 0.05;



    template <int dim>
    Tensor<1, dim>
    vector_at(const std::vector<double> &values, const std::size_t first)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = values[first + d];
      return result;
    }



    /// Of the last steps, with @p newest as that of this one.
    template <int dim>
    double
    mean_normal(const FacetImpulse<dim>                      &impulse,
                const typename FacetContact<dim>::Constraint &constraint,
                const double                                  newest)
    {
      return impulse.mean_normal +
             constraint.share_in_mean * (newest - impulse.mean_normal);
    }



    /// @p v, cut to the length @p limit.
    template <int dim>
    Tensor<1, dim>
    cut_to_length(const Tensor<1, dim> &v, const double limit)
    {
      const double length = v.norm();
      return length > limit ? v * (limit / length) : v;
    }
  } // namespace



  template <int dim>
  FacetContact<dim>::FacetContact(Obstacles<dim> &obstacles)
    : obstacles_(obstacles)
    , reactions_(obstacles.size())
  {}



  // Numbers of cells, facets and nodes have changed, and who owns them, but not
  // the key of a cell. Each rank takes what it needs from the impulses of all:
  // they are as many as the facets that soil touches, and the mesh changes
  // seldom.
  template <int dim>
  void
  FacetContact<dim>::prepare(const Grid<dim> &grid)
  {
    if (obstacles_.empty())
      return;
    std::vector<double> rows;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), rows_of_impulses()))
      rows.insert(rows.end(), of_rank.begin(), of_rank.end());
    facets_.prepare(grid, obstacles_);
    take_impulses(rows);
    constraints_.clear();
    exchange_of_records_.prepare(grid, width);
    exchange_of_impulses_.prepare(grid, dim);
    gaps_.prepare(grid, surfaces());
    records_.assign(std::size_t(width) * grid.n_nodes(), 0.);
    nodal_impulses_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
    total_impulses_.assign(std::size_t(dim) * grid.n_nodes(), 0.);
    held_.assign(grid.n_nodes(), 0);
  }



  /// The support function of a box along the normal.
  template <int dim>
  std::vector<typename NodalGaps<dim>::Surface>
  FacetContact<dim>::surfaces() const
  {
    std::vector<typename NodalGaps<dim>::Surface> result;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      result.push_back([&obstacle = obstacles_[k]](const Point<dim>     &x,
                                                   const Tensor<1, dim> &half) {
        auto [gap, normal] = obstacle.distance_and_normal(x);
        for (unsigned int d = 0; d < dim; ++d)
          gap -= half[d] * std::abs(normal[d]);
        return gap;
      });
    return result;
  }



  /// Of the facets that pass something.
  template <int dim>
  std::vector<double>
  FacetContact<dim>::rows_of_impulses() const
  {
    std::vector<double> rows;
    for (unsigned int c = 0; c < impulses_.size(); ++c)
      if (const FacetImpulse<dim> &impulse = impulses_[c];
          impulse.effective_mass > 0)
        {
          const ContactFacet<dim> &facet = facets_.owned()[c];
          // In halves, since a double does not hold all digits of a key.
          rows.insert(rows.end(),
                      {double(facet.key >> 32),
                       double(facet.key & 0xffffffff),
                       double(facet.obstacle),
                       impulse.normal,
                       impulse.effective_mass,
                       impulse.mean_normal});
          for (unsigned int d = 0; d < dim; ++d)
            rows.push_back(impulse.tangential[d]);
        }
    return rows;
  }



  template <int dim>
  void
  FacetContact<dim>::take_impulses(const std::vector<double> &rows)
  {
    std::map<std::array<double, 3>, FacetImpulse<dim>> by_key;
    for (std::size_t r = 0; r < rows.size(); r += n_columns)
      by_key[{{rows[r], rows[r + 1], rows[r + 2]}}] = {
        rows[r + 3], vector_at<dim>(rows, r + 6), rows[r + 4], rows[r + 5]};
    impulses_.assign(facets_.owned().size(), {});
    for (unsigned int c = 0; c < impulses_.size(); ++c)
      {
        const ContactFacet<dim> &facet = facets_.owned()[c];
        if (const auto found = by_key.find({{double(facet.key >> 32),
                                             double(facet.key & 0xffffffff),
                                             double(facet.obstacle)}});
            found != by_key.end())
          impulses_[c] = found->second;
      }
  }



  // Jacobi's iteration with mass splitting: all facets see the same velocities,
  // and a node's mass is shared by its facets, so that together they cannot push
  // it farther than one alone. One sweep per step is enough since it starts from
  // the impulses of the step before, and the order of the facets, and with it
  // the number of ranks, does not matter. What it needs of walls comes first: a
  // component that a wall holds is one that no facet can change.
  template <int dim>
  void
  FacetContact<dim>::apply(State<dim> &state, Boundaries<dim> &boundaries)
  {
    if (obstacles_.empty())
      return;
    hold_walls(state, boundaries);
    find_constraints(state);
    warm_start(state);
    const unsigned int n_sweeps = (!has_begun_         ? n_first_sweeps
                                   : obstacles_.move() ? n_sweeps_moving
                                                       : n_sweeps_at_rest);
    for (unsigned int s = 0; s < n_sweeps; ++s)
      sweep(state);
    for (const unsigned int c : loaded_)
      impulses_[c].mean_normal =
        mean_normal(impulses_[c], constraints_[c], impulses_[c].normal);
    has_begun_          = true;
    previous_time_step_ = state.time_step;
    for (const unsigned int node : active_nodes_)
      state.nodes.set_velocity(
        node, vector_at<dim>(records_, std::size_t(width) * node + velocity));
    hold_nodes_inside(state);
  }



  template <int dim>
  void
  FacetContact<dim>::find_constraints(const State<dim> &state)
  {
    take_restored(state);
    gaps_.find(state,
               facets_.nodes_and_obstacles(),
               facets_.nearness_of_cells());
    load_nodes(state);
    constraints_.clear();
    loaded_.clear();
    for (const ContactFacet<dim> &facet : facets_.owned())
      {
        constraints_.push_back(constraint_of(state, facet));
        if (constraints_.back().is_loaded)
          loaded_.push_back(constraints_.size() - 1);
      }
  }



  // A force is an impulse of one second, which the first step scales to its own
  // length as it does with that of a step before.
  template <int dim>
  void
  FacetContact<dim>::set_forces(const std::vector<FacetImpulse<dim>> &forces)
  {
    AssertDimension(forces.size(), facets_.owned().size());
    impulses_           = forces;
    previous_time_step_ = 1.;
    has_begun_          = true;
  }



  /// What a checkpoint held, once there are facets to give it to.
  template <int dim>
  void
  FacetContact<dim>::take_restored(const State<dim> &state)
  {
    if (restored_.empty())
      return;
    if (obstacles_.move())
      facets_.update(state.grid, obstacles_);
    take_impulses(restored_);
    restored_.clear();
  }



  /// To where they are at the end of the step. Impulses stay with their cells.
  template <int dim>
  void
  FacetContact<dim>::move_obstacles(const State<dim> &state)
  {
    if (obstacles_.empty())
      return;
    take_restored(state);
    if (!obstacles_.move())
      return;
    const std::vector<double> rows = rows_of_impulses();
    obstacles_.advance(state.time, state.time_step);
    facets_.update(state.grid, obstacles_);
    take_impulses(rows);
  }



  /// Give nodes that walls hold or drive their velocity; remember which
  /// components.
  template <int dim>
  void
  FacetContact<dim>::hold_walls(State<dim> &state, Boundaries<dim> &boundaries)
  {
    for (const unsigned int node : facets_.nodes())
      if (const unsigned char faces = state.grid.faces_of_node(node))
        held_[node] = boundaries.components_constrained_by_walls(faces);
    for (const unsigned int node : facets_.owned_nodes())
      if (held_[node] && state.nodes.mass(node) > state.mass_cutoff)
        boundaries.impose_walls(state.nodes,
                                state.grid.faces_of_node(node),
                                node,
                                state.time,
                                state.time_step,
                                state.works);
  }



  /// Velocities after the momentum update, and how much of the room at a node
  /// the soil fills.
  template <int dim>
  void
  FacetContact<dim>::load_nodes(const State<dim> &state)
  {
    const NodalFields<dim> &nodes = state.nodes;
    active_nodes_.clear();
    for (const unsigned int node : facets_.owned_nodes())
      {
        double *const record = records_.data() + std::size_t(width) * node;
        std::fill_n(record, width, 0.);
        std::fill_n(total_impulses_.begin() + std::size_t(dim) * node, dim, 0.);
        const double mass = nodes.mass(node);
        const double room = facets_.open_volume(node);
        if (mass <= state.mass_cutoff || room <= 0)
          continue;
        active_nodes_.push_back(node);
        record[fill]      = std::min(1., nodes.volume(node) / room);
        record[splitting] = facets_.n_facets(node) / mass;
        for (unsigned int d = 0; d < dim; ++d)
          record[velocity + d] = nodes.velocity(node)[d];
      }
    exchange_of_records_.copy_to_ghosts(records_.data());
  }



  // Shares by filling as well as by shape functions: a node that hardly has soil
  // must not decide how the soil at the facet moves. Shares by mass would shift
  // the wall into the soil.
  template <int dim>
  typename FacetContact<dim>::Constraint
  FacetContact<dim>::constraint_of(const State<dim>        &state,
                                   const ContactFacet<dim> &facet) const
  {
    Constraint result;
    double     sum = 0;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      {
        result.share[v] = facet.shape_value[v] *
                          records_[std::size_t(width) * facet.node[v] + fill];
        sum += result.share[v];
      }
    if (sum <= 0)
      return result;
    const Cell<dim> &cell = state.grid.cells()[facet.cell];
    AssertThrow(cell.uniform,
                ExcPoint(text("Soil has come to the surface of the obstacle '",
                              obstacles_[facet.obstacle].name(),
                              "' at (",
                              facet.centroid,
                              ") m, where cells of different size meet, but "
                              "contact needs cells of one size there. Let "
                              "'Grid/Refinement boxes' cover the surface as "
                              "far as soil may come, or leave more cells in "
                              "'Mesh tracking' around the soil.")));
    double inverse_mass = 0, inverse_normal_mass = 0;
    result.gap = NodalGaps<dim>::none;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      {
        const unsigned int node = facet.node[v];
        result.share[v] /= sum;
        if (result.share[v] == 0)
          continue;
        const double inverse = result.share[v] * result.share[v] *
                               records_[std::size_t(width) * node + splitting];
        double free = 1.; // share of the normal that no wall holds
        for (unsigned int d = 0; d < dim; ++d)
          if (held_[node] & (1u << d))
            free -= facet.normal[d] * facet.normal[d];
        inverse_mass += inverse;
        inverse_normal_mass += free * inverse;
        result.gap =
          std::min(result.gap, gaps_.room(node, facet.obstacle, cell.size));
      }
    result.is_loaded = true;
    result.mass      = 1. / inverse_mass;
    result.normal_mass =
      (inverse_normal_mass > 1e-6 * inverse_mass ? 1. / inverse_normal_mass
                                                 : 0.);
    result.area          = facet.area * sum;
    result.share_in_mean = share_in_mean(state, facet, result);
    return result;
  }



  // Where an elastic body may ring, Coulomb friction on a rigid surface has no
  // steady sliding: the normal force and its friction feed the waves, the body
  // chatters, slips by turns and is thrown up. What tames it is that friction does
  // not follow the normal force at once, but within some slip or time (@cite
  // cochard2000). It is impulses that are remembered, not pressures: then
  // their sum is kept while soil slides from facet to facet, and with it the mean
  // force.
  template <int dim>
  double
  FacetContact<dim>::share_in_mean(const State<dim>        &state,
                                   const ContactFacet<dim> &facet,
                                   const Constraint        &constraint) const
  {
    if (!has_begun_)
      return 1.;
    const double         dt = state.time_step;
    const Tensor<1, dim> u =
      velocity_at(facet, constraint) -
      obstacles_[facet.obstacle].velocity(state.time + 0.5 * dt);
    const double slip = (u - (u * facet.normal) * facet.normal).norm() * dt;
    return std::min(1.,
                    1. / n_steps_of_memory +
                      slip /
                        (slip_of_memory * state.grid.cells()[facet.cell].size));
  }



  template <int dim>
  double
  FacetContact<dim>::friction_limit(const ContactFacet<dim> &facet,
                                    const Constraint        &constraint,
                                    const double             normal_impulse,
                                    const double             dt) const
  {
    const double friction = obstacles_.friction_factor() *
                            obstacles_[facet.obstacle].friction_coefficient() *
                            normal_impulse;
    // Whatever share of it a trigger leaves.
    if (std::isinf(facet.maximum_shear_stress))
      return friction;
    return std::min(friction,
                    obstacles_.shear_stress_factor() *
                      facet.maximum_shear_stress * constraint.area * dt);
  }



  /// To the nodes, in shares.
  template <int dim>
  void
  FacetContact<dim>::add_impulse(const ContactFacet<dim> &facet,
                                 const Constraint        &constraint,
                                 const Tensor<1, dim>    &impulse)
  {
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        nodal_impulses_[std::size_t(dim) * facet.node[v] + d] +=
          constraint.share[v] * impulse[d];
  }



  // The impulses of the step before, and not more of them than the mass that is
  // still there warrants: where soil becomes thin, they would throw the light
  // nodes that are left.
  template <int dim>
  void
  FacetContact<dim>::warm_start(const State<dim> &state)
  {
    const double longer =
      (previous_time_step_ > 0 ? state.time_step / previous_time_step_ : 1.);
    for (unsigned int c = 0; c < impulses_.size(); ++c)
      {
        const Constraint        &constraint = constraints_[c];
        const ContactFacet<dim> &facet      = facets_.owned()[c];
        FacetImpulse<dim>       &impulse    = impulses_[c];
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
        impulse.tangential     = cut_to_length(factor * impulse.tangential,
                                           friction_limit(facet,
                                                          constraint,
                                                          impulse.mean_normal,
                                                          state.time_step));
        impulse.effective_mass = constraint.mass;
        add_impulse(facet,
                    constraint,
                    impulse.normal * facet.normal + impulse.tangential);
      }
    update_velocities(state);
  }



  /// Of the soil at the contact point.
  template <int dim>
  Tensor<1, dim>
  FacetContact<dim>::velocity_at(const ContactFacet<dim> &facet,
                                 const Constraint        &constraint) const
  {
    Tensor<1, dim> u;
    for (unsigned int v = 0; v < facet.node.size(); ++v)
      u +=
        constraint.share[v] *
        vector_at<dim>(records_, std::size_t(width) * facet.node[v] + velocity);
    return u;
  }



  // Projections: the normal impulse pushes only, and friction is at most what
  // the surface passes. A facet with a gap lets the soil come as near in this
  // step as the gap allows.
  template <int dim>
  void
  FacetContact<dim>::sweep(const State<dim> &state)
  {
    const double                dt = state.time_step;
    std::vector<Tensor<1, dim>> of_obstacle;
    for (unsigned int k = 0; k < obstacles_.size(); ++k)
      of_obstacle.push_back(obstacles_[k].velocity(state.time + 0.5 * dt));
    for (const unsigned int c : loaded_)
      {
        const Constraint &constraint = constraints_[c];
        if (constraint.normal_mass == 0)
          continue;
        const ContactFacet<dim> &facet   = facets_.owned()[c];
        FacetImpulse<dim>       &impulse = impulses_[c];
        const Tensor<1, dim>     u =
          velocity_at(facet, constraint) - of_obstacle[facet.obstacle];
        const double         u_n = u * facet.normal;
        const Tensor<1, dim> u_t = u - u_n * facet.normal;

        const double normal =
          std::max(0.,
                   impulse.normal -
                     constraint.normal_mass * (constraint.gap / dt + u_n));
        const Tensor<1, dim> tangential =
          cut_to_length(impulse.tangential - constraint.mass * u_t,
                        friction_limit(facet,
                                       constraint,
                                       mean_normal(impulse, constraint, normal),
                                       dt));
        add_impulse(facet,
                    constraint,
                    (normal - impulse.normal) * facet.normal + tangential -
                      impulse.tangential);
        impulse.normal     = normal;
        impulse.tangential = tangential;
      }
    update_velocities(state);
  }



  /// Collective. Components that walls hold do not move: the wall takes the
  /// impulse up.
  template <int dim>
  void
  FacetContact<dim>::update_velocities(const State<dim> &state)
  {
    exchange_of_impulses_.add_to_owners(nodal_impulses_.data());
    for (const unsigned int node : active_nodes_)
      {
        double *const impulse =
          nodal_impulses_.data() + std::size_t(dim) * node;
        double *const record = records_.data() + std::size_t(width) * node;
        for (unsigned int d = 0; d < dim; ++d)
          {
            if (!(held_[node] & (1u << d)))
              record[velocity + d] += impulse[d] / state.nodes.mass(node);
            total_impulses_[std::size_t(dim) * node + d] += impulse[d];
            impulse[d] = 0;
          }
      }
    exchange_of_records_.copy_to_ghosts(records_.data());
  }



  template <int dim>
  double
  FacetContact<dim>::gap_inside(
    const Grid<dim> &grid, const typename Facets<dim>::NodeInside &inside) const
  {
    return gaps_.room(inside.node, inside.obstacle, grid.finest_size());
  }



  // Soil that dips below the surface reaches nodes that no facet touches. They
  // carry less than a thousandth of the force, and without a rule they would
  // fall. Their area in contact is zero, so they pass no friction.
  template <int dim>
  void
  FacetContact<dim>::hold_nodes_inside(State<dim> &state)
  {
    impulses_inside_.clear();
    const double dt = state.time_step;
    for (const auto &inside : facets_.nodes_inside())
      {
        const double mass = state.nodes.mass(inside.node);
        if (mass <= state.mass_cutoff)
          continue;
        const Obstacle<dim> &obstacle = obstacles_[inside.obstacle];
        const Tensor<1, dim> n        = obstacle.normal(inside.place);
        const double         may_move = -gap_inside(state.grid, inside) / dt;
        const Tensor<1, dim> v        = state.nodes.velocity(inside.node);
        const double v_n = (v - obstacle.velocity(state.time + 0.5 * dt)) * n;
        if (v_n < may_move)
          impulses_inside_.push_back(
            {inside.node,
             inside.obstacle,
             inside.place,
             state.nodes.set_velocity(inside.node, v + (may_move - v_n) * n)});
      }
  }



  /// Walls take up what obstacles do to the components that they hold.
  template <int dim>
  void
  FacetContact<dim>::book_walls(State<dim>      &state,
                                Boundaries<dim> &boundaries) const
  {
    for (const unsigned int node : facets_.owned_nodes())
      if (held_[node])
        {
          Tensor<1, dim> taken_up;
          for (unsigned int d = 0; d < dim; ++d)
            if (held_[node] & (1u << d))
              taken_up[d] = -total_impulses_[std::size_t(dim) * node + d];
          boundaries.book_walls(state.nodes,
                                state.grid.faces_of_node(node),
                                node,
                                taken_up,
                                state.works);
        }
  }



  /// This rank's shares.
  template <int dim>
  void
  FacetContact<dim>::book_facets(const State<dim>               &state,
                                 std::vector<StepReaction<dim>> &steps) const
  {
    for (const unsigned int c : loaded_)
      {
        const FacetImpulse<dim> &impulse = impulses_[c];
        if (!impulse.acts())
          continue;
        const ContactFacet<dim> &facet      = facets_.owned()[c];
        const Constraint        &constraint = constraints_[c];
        StepReaction<dim>       &step       = steps[facet.obstacle];
        Tensor<1, dim>           v;
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



  // Works are taken with the mean of the velocities before and after the step,
  // when the last condition has acted: only so do they add up to nothing with
  // the kinetic energy.
  template <int dim>
  void
  FacetContact<dim>::book(State<dim> &state, Boundaries<dim> &boundaries)
  {
    if (obstacles_.empty())
      return;
    book_walls(state, boundaries);
    std::vector<StepReaction<dim>> steps(obstacles_.size());
    book_facets(state, steps);
    for (const StepReaction<dim> &step : steps)
      {
        state.works.friction += step.friction_work;
        state.works.contact += step.contact_work;
      }
    add_to_reactions(steps, state.time_step, state.communicator(), reactions_);
  }



  template <int dim>
  void
  FacetContact<dim>::start_interval()
  {
    for (Reaction<dim> &reaction : reactions_)
      reaction.start_interval();
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
    list.add_table(
      {"facet impulses",
       "key of the cell: upper and lower 32 bits; obstacle; normal impulse [N "
       "s]; "
       "effective mass [kg]; mean normal impulse [N s]; friction impulse [N s]",
       n_columns,
       [this]() { return rows_of_impulses(); },
       [this](const std::vector<double> &rows) { restored_ = rows; }});
  }



  template class FacetContact<2>;
  template class FacetContact<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/static_contact.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Stiffness of the springs, over shear modulus times area over cell size
    // [-]. Each loop reduces the error by about this factor, but the matrix
    // becomes worse conditioned. A stiffness proportional to the area leaves
    // slivers to their neighbouring facets, with which slivers are nearly
    // redundant.
    constexpr double spring = 100.;

    // Largest number of loops for the springs. Forces that alternate from facet
    // to facet hardly move the soil: they converge slowly and need not
    // converge.
    constexpr unsigned int max_loops = 5;

    // Slack for the round-off of forces cut to the friction.
    constexpr double slack = 1. + 1e-12;
  } // namespace



  // Soil new at an obstacle has no normal force yet, and hence no friction.
  template <int dim>
  void
  StaticPlace<dim>::begin()
  {
    const bool is_new = !(given * normal > 0);
    if (n_nodes == 0)
      {
        given  = {};
        opened = 0;
        state  = ContactState::open;
      }
    gap          = (is_new ? std::max(0., gap + opened) : 0.);
    sticks_first = is_new;
    find_force({});
  }



  // With the gap g, the displacement u and the spring k,
  //   N = max(0, N_given - k (g + u n)),
  //   T = T_given - k (u - (u n) n), cut to min(mu N, tau_max A).
  // Soil that slips has slipped against the friction by its displacement along
  // the surface: at the end of the loops the spring is not deformed.
  //
  // Without spring only slip changes the friction within a loop: the matrix
  // stays symmetric, and update() corrects the forces between the loops. What
  // slip takes away depends on the displacement, so that a load step either
  // ends on a balance or fails.
  template <int dim>
  void
  StaticPlace<dim>::find_force(const std::vector<double> &u)
  {
    const Tensor<1, dim> moved    = displacement(u);
    const Tensor<1, dim> trial    = given - stiffness * (moved + gap * normal);
    const double         N        = trial * normal;
    const double         length   = tangential(trial).norm();
    const double         friction = limit.force(N);
    if (stiffness > 0)
      state = (N < 0                        ? ContactState::open
               : length >= slack * friction ? ContactState::slips
                                            : ContactState::sticks);
    slip  = 0;
    force = {};
    if (state == ContactState::open)
      return;
    direction = (length > 0 ? tangential(trial) / length : force);
    if (state == ContactState::slips && friction > 0 && limit.softens())
      slip = std::max(0., -(moved * direction));
    cut   = (length > 0 ? std::min(1., limit.force(N, slip) / length) : 0.);
    force = N * normal + cut * tangential(trial);
  }



  // While the soil slips, the friction is mu N or its cap in the direction of
  // slip, and the direction turns with the slip.
  template <int dim>
  Tensor<2, dim>
  StaticPlace<dim>::tangent() const
  {
    const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
    if (state == ContactState::open)
      return Tensor<2, dim>();
    if (state == ContactState::sticks || sticks_first)
      return stiffness * identity;
    const double         N              = force * normal;
    const Tensor<2, dim> along_normal   = outer_product(normal, normal);
    const Tensor<2, dim> along_friction = outer_product(direction, direction);
    Tensor<2, dim>       result =
      along_normal + cut * (identity - along_normal - along_friction);
    if (limit.increases_at(N, slip))
      result += limit.coefficient * outer_product(direction, normal);
    return stiffness * result + limit.slope(N, slip) * along_friction;
  }



  // The rules are
  //   open    -> sticks  if soil has moved into the face;
  //   any     -> open    if the face would have to pull;
  //   sticks  -> slips   if the force along the face exceeds the largest
  //                      friction, which then acts in the same direction;
  //   slips   -> sticks  if the node moved along the friction.
  // The friction of a slipping node follows the normal force. The direction of
  // slip is kept from the start of slip; in 2-D there is only one. Components
  // held by walls are not friction. With the tolerance, round-off does not
  // change states for ever.
  template <int dim>
  bool
  StaticPlace<dim>::update(const Tensor<1, dim>      &reaction,
                           const unsigned char        walls,
                           const std::vector<double> &u,
                           const double               tolerance)
  {
    const ContactState   old_state    = state;
    const Tensor<1, dim> old_friction = tangential(force);
    const Tensor<1, dim> moved        = displacement(u);
    Tensor<1, dim>       friction     = tangential(given);
    if (state == ContactState::open)
      state = (moved * normal < 0. ? ContactState::sticks : ContactState::open);
    else if (reaction * normal < -tolerance)
      {
        state = ContactState::open;
        given = {};
      }
    else
      {
        const double N       = std::max(reaction * normal, 0.);
        const double largest = limit.force(N);
        if (state == ContactState::sticks)
          {
            friction = tangential(reaction);
            for (unsigned int d = 0; d < dim; ++d)
              if (walls & (1u << d))
                friction[d] = 0.;
            if (friction.norm() > largest + tolerance)
              state = ContactState::slips;
          }
        else if (moved * friction > 0.)
          state = ContactState::sticks;
        if (const double length = friction.norm();
            state == ContactState::slips && length > 0.)
          friction *= largest / length;
        given = N * normal + friction;
      }
    find_force(u);
    return state != old_state ||
           (state == ContactState::slips &&
            (tangential(force) - old_friction).norm() > tolerance);
  }



  namespace
  {
    /// Add all facets to @p places, also without soil, so that the numbers of
    /// facets are kept. The dynamics starts from the forces of facets, and
    /// keeps them as impulses in 1 s.
    template <int dim>
    void
    add_facets(const StaticProblem<dim>     &problem,
               const double                  modulus,
               PlaceTable<StaticPlace<dim>> &places)
    {
      const auto &facets = problem.contact.facets().owned();
      for (unsigned int k = 0; k < facets.size(); ++k)
        {
          const auto      &constraint = problem.contact.constraints()[k];
          StaticPlace<dim> place;
          if (constraint.is_loaded)
            {
              for (unsigned int v = 0; v < place.max_nodes; ++v)
                place.add_node(facets[k].node[v], constraint.share[v]);
              place.centroid  = facets[k].centroid;
              place.normal    = facets[k].normal;
              place.area      = constraint.area;
              place.gap       = constraint.gap;
              place.stiffness = spring * modulus * constraint.area /
                                problem.state.grid.cells()[facets[k].cell].size;
              place.limit  = problem.contact.constraints().limit(k);
              place.number = k;
            }
          places.push_back(key_of(facets[k]), place);
        }
    }



    /// Add nodes inside obstacles that touch no facet to @p places, as in the
    /// dynamics: without area and so without friction.
    template <int dim>
    void
    add_nodes_inside(const StaticProblem<dim>     &problem,
                     const Unknowns<dim>          &unknowns,
                     const double                  modulus,
                     PlaceTable<StaticPlace<dim>> &places)
    {
      const Grid<dim> &grid = problem.state.grid;
      const double     h    = grid.finest_size();
      const auto       keys = keys_of_owned_nodes(grid);
      for (const auto &inside : problem.contact.facets().nodes_inside())
        if (unknowns.is_active(inside.node))
          {
            StaticPlace<dim> place;
            place.add_node(inside.node, 1.);
            place.normal =
              problem.contact.obstacles()[inside.obstacle].normal(inside.place);
            place.gap = problem.contact.constraints().gap_inside(grid, inside);
            place.stiffness =
              spring * modulus * unknowns.volume(inside.node) / (h * h);
            places.push_back(
              place_key(keys[inside.node], inside.obstacle + 1, -1.), place);
          }
    }



    /// Add nodes on seabed faces to @p places. The area in contact is the area
    /// of the dynamics: both must find the same friction.
    template <int dim>
    void
    add_nodes_on_faces(const StaticProblem<dim>     &problem,
                       const Unknowns<dim>          &unknowns,
                       PlaceTable<StaticPlace<dim>> &places)
    {
      const auto &at          = problem.contact.face_nodes();
      const auto &constraints = problem.contact.constraints();
      for (const unsigned int node : unknowns.active_nodes())
        at.for_each_at(node, [&](const unsigned int i) {
          StaticPlace<dim> place;
          place.add_node(node, 1.);
          place.normal = at[i].normal();
          place.number = constraints.place_of_node(i);
          place.limit  = constraints.limit(place.number);
          places.push_back(at[i].key, place);
        });
    }
  } // namespace



  /// States are kept between load steps: if the soil started by sticking
  /// everywhere, each step would have to find the slipping places again, with
  /// one Newton loop after another. Numbers of nodes change, places do not.
  template <int dim>
  void
  StaticContact<dim>::begin(const StaticProblem<dim> &problem,
                            const Unknowns<dim>      &unknowns,
                            const double              modulus)
  {
    const Obstacles<dim> &obstacles = problem.contact.obstacles();
    n_loops_                        = 0;
    is_symmetric_                   = true;
    Places now;
    problem.contact.find_constraints(problem.state);
    if (!obstacles.empty())
      {
        for (unsigned int k = 0; k < obstacles.size(); ++k)
          is_symmetric_ &= (obstacles[k].bed().coefficient() == 0);
        add_facets(problem, modulus, now);
        add_nodes_inside(problem, unknowns, modulus, now);
      }
    add_nodes_on_faces(problem, unknowns, now);
    places_.move_to(now.places(), unknowns.communicator());
    const auto        &impulses = problem.contact.impulses();
    const unsigned int n_facets = problem.contact.facets().owned().size();
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        now[i].values() = places_[i].values();
        places_[i]      = now[i];
        if (i < n_facets)
          places_[i].given =
            impulses[i].normal * now[i].normal + impulses[i].tangential;
        places_[i].begin();
      }
  }



  /// Slipping nodes are held along the normal only, open nodes only by walls.
  template <int dim>
  std::vector<unsigned char>
  StaticContact<dim>::held(const StaticProblem<dim> &problem,
                           const Unknowns<dim>      &unknowns) const
  {
    const Grid<dim>           &grid = problem.state.grid;
    std::vector<unsigned char> result(grid.n_owned_nodes(), 0);
    for (const unsigned int node : unknowns.active_nodes())
      result[node] = problem.boundaries.components_constrained_by_walls(
        grid.faces_of_node(node));
    for (const auto &place : places_.all())
      for (unsigned int d = 0; d < dim; ++d)
        if (place.stiffness == 0 && place.state != ContactState::open &&
            (place.state == ContactState::sticks || place.normal[d] != 0))
          result[place.node[0]] |= 1u << d;
    return result;
  }



  template <int dim>
  void
  StaticContact<dim>::add_forces(const double               factor,
                                 const std::vector<double> &u,
                                 std::vector<double>       &forces)
  {
    for (auto &place : places_)
      {
        place.find_force(u);
        place.distribute(factor * place.force, forces);
      }
  }



  template <int dim>
  void
  StaticContact<dim>::add_pressure(
    const std::function<double(const Point<dim> &)> &pressure,
    std::vector<double>                             &forces) const
  {
    for (const auto &place : places_.all())
      if (place.area > 0.)
        place.distribute(pressure(place.centroid) * place.area * place.normal,
                         forces);
  }



  template <int dim>
  void
  StaticContact<dim>::couple(StiffnessMatrix<dim> &matrix) const
  {
    for (const auto &place : places_.all())
      if (place.stiffness > 0)
        matrix.couple({place.node.data(), place.n_nodes});
  }



  template <int dim>
  void
  StaticContact<dim>::add_to_matrix(StiffnessMatrix<dim> &matrix)
  {
    FullMatrix<double> block;
    for (auto &place : places_)
      {
        const Tensor<2, dim> k = place.tangent();
        place.sticks_first     = false;
        if (k.norm_square() == 0)
          continue;
        const unsigned int n = dim * place.n_nodes;
        block.reinit(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            block(i, j) =
              place.share[i / dim] * place.share[j / dim] * k[i % dim][j % dim];
        matrix.add({place.node.data(), place.n_nodes}, block);
      }
  }



  /// Update the nodes on faces. Returns the number of changes on this rank. The
  /// negative residual is the change of the force at held components; free
  /// components hold the residual left by Newton's method.
  template <int dim>
  unsigned int
  StaticContact<dim>::update_held(const StaticProblem<dim>  &problem,
                                  const Unknowns<dim>       &unknowns,
                                  const std::vector<double> &residual,
                                  std::vector<double>       &u)
  {
    std::vector<double> forces = unknowns.field();
    for (const auto &place : places_.all())
      if (place.stiffness == 0)
        place.distribute(place.force, forces);
    unsigned int n_changes = 0;
    for (auto &place : places_)
      if (place.stiffness == 0 && place.n_nodes > 0)
        {
          const unsigned int node = place.node[0];
          Tensor<1, dim>     reaction;
          for (unsigned int d = 0; d < dim; ++d)
            reaction[d] = forces[dim * node + d] - residual[dim * node + d];
          // Force at the node plus weight of its soil, as either may be zero.
          const double weight =
            reaction.norm() +
            unknowns.mass(node) * problem.loads.acceleration_of_body[0].norm();
          n_changes +=
            place.update(reaction,
                         problem.boundaries.components_constrained_by_walls(
                           problem.state.grid.faces_of_node(node)),
                         u,
                         1e-6 * weight);
          // A node that has come down on the face stays there: the next loop
          // holds its normal displacement at zero.
          for (unsigned int d = 0; d < dim; ++d)
            if (place.state != ContactState::open && place.normal[d] != 0)
              u[dim * node + d] = 0.;
        }
    return n_changes;
  }



  // The remaining force of a spring over its stiffness is the distance that the
  // soil moved against the contact. The mean is weighted by area, so that
  // slivers, whose springs are soft, do not dominate. If the forces hardly
  // change, displacements are round-off and no measure of the error.
  template <int dim>
  unsigned int
  StaticContact<dim>::update(const StaticProblem<dim>  &problem,
                             const Unknowns<dim>       &unknowns,
                             const std::vector<double> &residual,
                             std::vector<double>       &u,
                             const double               tolerance)
  {
    const MPI_Comm     communicator = unknowns.communicator();
    const unsigned int n_changes =
      Utilities::MPI::sum(update_held(problem, unknowns, residual, u),
                          communicator);
    // Area, area times error squared, change of forces, forces; of springs.
    std::vector<double> sums(4, 0.);
    for (auto &place : places_)
      if (place.stiffness > 0)
        {
          const Tensor<1, dim> more = place.force - place.given;
          const double         change =
            std::abs(more * place.normal) + place.tangential(more).norm();
          sums[0] += place.area;
          sums[1] += place.area * std::pow(change / place.stiffness, 2);
          sums[2] += change;
          sums[3] +=
            place.force * place.normal + place.tangential(place.force).norm();
          place.given = place.force;
        }
    Utilities::MPI::sum(sums, communicator, sums);
    double largest = 0;
    for (const double x : u)
      largest = std::max(largest, std::abs(x));
    largest = Utilities::MPI::max(largest, communicator);
    const bool springs_rest =
      ++n_loops_ >= max_loops ||
      std::sqrt(sums[1]) <= tolerance * largest * std::sqrt(sums[0]) ||
      sums[2] <= 1e-9 * sums[3];
    return n_changes + (springs_rest ? 0 : 1);
  }



  /// Only the sign of the direction counts: its size is the size of a
  /// correction from a nearly singular matrix. The tangent of sticking keeps
  /// the next iterate from being a mechanism; the force of a spring stays cut
  /// to the friction.
  template <int dim>
  unsigned int
  StaticContact<dim>::stick_again(const Unknowns<dim>       &unknowns,
                                  const std::vector<double> &direction)
  {
    unsigned int n_changes = 0;
    for (auto &place : places_)
      if (place.state == ContactState::slips && !place.sticks_first &&
          place.tangential(place.force) * place.displacement(direction) > 0)
        {
          place.state        = ContactState::sticks;
          place.sticks_first = true;
          ++n_changes;
        }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  /// Points do not move, so the motion of the soil towards the obstacle must be
  /// remembered.
  template <int dim>
  void
  StaticContact<dim>::commit(const StaticProblem<dim>  &problem,
                             const std::vector<double> &u)
  {
    const auto        &constraints = problem.contact.constraints();
    const unsigned int n_facets    = constraints.place_of_node(0);
    std::vector<ContactImpulse<dim>> forces;
    for (auto &place : places_)
      {
        const double moved = place.displacement(u) * place.normal;
        const double N     = place.force * place.normal;
        place.given        = place.force;
        place.opened += moved;
        if (place.slip > 0)
          problem.contact.slip().add(place.number, place.slip);
        if (const unsigned int k = forces.size(); k < n_facets)
          forces.push_back({N,
                            place.tangential(place.force),
                            place.stiffness > 0 ? constraints[k].mass : 0.,
                            N,
                            N > 0 ? place.area : 0.});
      }
    if (!problem.contact.obstacles().empty())
      problem.contact.set_forces(forces);
  }



  template struct StaticPlace<2>;
  template struct StaticPlace<3>;
  template class StaticContact<2>;
  template class StaticContact<3>;
} // namespace talus

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



  /// States are kept between load steps: if the soil started by sticking
  /// everywhere, each step would have to find the slipping places again, with
  /// one Newton loop after another. Numbers of nodes change, places do not.
  template <int dim>
  void
  StaticContact<dim>::begin(const StaticProblem<dim> &problem,
                            const Unknowns<dim>      &unknowns,
                            const double              modulus)
  {
    n_loops_      = 0;
    is_symmetric_ = true;
    PlaceTable<Place> now;
    if (!problem.contact.obstacles().empty())
      {
        add_facets(problem, modulus, now);
        add_nodes_inside(problem, unknowns, modulus, now);
      }
    add_nodes_on_faces(problem, unknowns, now);
    places_.move_to(now.places(), unknowns.communicator());
    const auto &impulses = problem.contact.impulses();
    for (unsigned int i = 0; i < now.size(); ++i)
      {
        now[i].values() = places_[i].values();
        places_[i]      = now[i];
        places_[i].begin(i < impulses.size() ? &impulses[i] : nullptr);
      }
  }



  /// Add all facets, also without soil, so that the numbers of facets are kept.
  template <int dim>
  void
  StaticContact<dim>::add_facets(const StaticProblem<dim> &problem,
                                 const double              modulus,
                                 PlaceTable<Place>        &places) const
  {
    problem.contact.find_constraints(problem.state);
    const auto &facets = problem.contact.facets().owned();
    for (unsigned int k = 0; k < facets.size(); ++k)
      {
        const auto &constraint = problem.contact.constraints()[k];
        Place       place;
        if (constraint.is_loaded)
          {
            for (unsigned int v = 0; v < Place::max_nodes; ++v)
              place.add_node(facets[k].node[v], constraint.share[v]);
            place.centroid  = facets[k].centroid;
            place.normal    = facets[k].normal;
            place.area      = constraint.area;
            place.gap       = constraint.gap;
            place.stiffness = spring * modulus * constraint.area /
                              problem.state.grid.cells()[facets[k].cell].size;
            place.limit         = problem.contact.constraints().limit(k);
            place.number_in_bed = k;
          }
        places.push_back(key_of(facets[k]), place);
      }
  }



  /// Add nodes inside obstacles that touch no facet, as in the dynamics:
  /// without area and so without friction.
  template <int dim>
  void
  StaticContact<dim>::add_nodes_inside(const StaticProblem<dim> &problem,
                                       const Unknowns<dim>      &unknowns,
                                       const double              modulus,
                                       PlaceTable<Place>        &places) const
  {
    const Grid<dim> &grid = problem.state.grid;
    const double     h    = grid.finest_size();
    const auto       keys = keys_of_owned_nodes(grid);
    for (const auto &inside : problem.contact.facets().nodes_inside())
      if (unknowns.is_active(inside.node))
        {
          Place place;
          place.add_node(inside.node, 1.);
          place.normal =
            problem.contact.obstacles()[inside.obstacle].normal(inside.place);
          place.gap = problem.contact.constraints().gap_inside(grid, inside);
          place.stiffness =
            spring * modulus * unknowns.volume(inside.node) / (h * h);
          places.push_back(place_key(keys[inside.node], inside.obstacle, -1.),
                           place);
        }
  }



  /// The area in contact is the area of the dynamics: both must find the same
  /// friction.
  template <int dim>
  void
  StaticContact<dim>::add_nodes_on_faces(const StaticProblem<dim> &problem,
                                         const Unknowns<dim>      &unknowns,
                                         PlaceTable<Place>        &places) const
  {
    const Grid<dim>   &grid   = problem.state.grid;
    const Seabed<dim> &seabed = problem.boundaries.seabed();
    const auto         keys   = keys_of_owned_nodes(grid);
    for (const unsigned int node : unknowns.active_nodes())
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if ((grid.faces_of_node(node) & (1u << face)) &&
            problem.boundaries.is_seabed(face))
          {
            Place place;
            place.add_node(node, 1.);
            place.normal[face / 2] = (face % 2 == 0 ? 1. : -1.);
            place.limit            = seabed.limit(
              face,
              node,
              seabed.contact_area(problem.state.nodes, grid, face, node));
            place.number_in_bed = seabed.place_of(face, node);
            places.push_back(place_key(keys[node], face, -2.), place);
          }
  }



  template <int dim>
  void
  StaticContact<dim>::Place::add_node(const unsigned int index,
                                      const double       weight)
  {
    if (weight > 0)
      {
        node[n_nodes]  = index;
        share[n_nodes] = weight;
        ++n_nodes;
      }
  }



  /// Facets share their forces @p impulse with the dynamics, for a time of 1 s.
  template <int dim>
  void
  StaticContact<dim>::Place::begin(const FacetImpulse<dim> *impulse)
  {
    if (impulse != nullptr)
      given = {impulse->normal, impulse->tangential};
    if (n_nodes == 0)
      {
        given  = {};
        opened = 0;
        state  = State::open;
      }
    gap = (given.normal > 0 ? 0. : std::max(0., gap + opened));
    // Soil new at an obstacle has no normal force yet, and hence no friction.
    sticks_first = (given.normal == 0);
    find_force({});
  }



  /// Displacement of the place, m; zero if @p u is empty.
  template <int dim>
  Tensor<1, dim>
  StaticContact<dim>::Place::displacement(const std::vector<double> &u) const
  {
    Tensor<1, dim> result;
    for (unsigned int v = 0; v < (u.empty() ? 0 : n_nodes); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        result[d] += share[v] * u[std::size_t(dim) * node[v] + d];
    return result;
  }



  template <int dim>
  void
  StaticContact<dim>::Place::distribute(const Tensor<1, dim> &force,
                                        std::vector<double>  &forces) const
  {
    for (unsigned int v = 0; v < n_nodes; ++v)
      for (unsigned int d = 0; d < dim; ++d)
        forces[std::size_t(dim) * node[v] + d] += share[v] * force[d];
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
  StaticContact<dim>::Place::find_force(const std::vector<double> &u)
  {
    const Tensor<1, dim> d          = displacement(u);
    const double         d_n        = d * normal;
    const Tensor<1, dim> d_t        = d - d_n * normal;
    const Tensor<1, dim> tangential = given.tangential - stiffness * d_t;
    const double         length     = tangential.norm();
    found.normal                    = given.normal - stiffness * (gap + d_n);
    const double friction           = limit.force(found.normal);
    if (stiffness > 0)
      state = (found.normal < 0             ? State::open
               : length >= slack * friction ? State::slips
                                            : State::sticks);
    slip = 0;
    if (state == State::open)
      {
        found = {};
        return;
      }
    direction = (length > 0 ? tangential / length : Tensor<1, dim>());
    if (state == State::slips && friction > 0 && limit.softens())
      slip = std::max(0., -(d_t * direction));
    cut = (length > 0 ? std::min(1., limit.force(found.normal, slip) / length)
                      : 0.);
    found.tangential = cut * tangential;
  }



  /// Negative derivative of the force by the displacement, N/m. While the soil
  /// slips, the friction is mu N or its cap in the direction of slip, and the
  /// direction turns with the slip.
  template <int dim>
  Tensor<2, dim>
  StaticContact<dim>::Place::tangent() const
  {
    const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
    if (state == State::open)
      return Tensor<2, dim>();
    if (state == State::sticks || sticks_first)
      return stiffness * identity;
    const Tensor<2, dim> along_normal   = outer_product(normal, normal);
    const Tensor<2, dim> along_friction = outer_product(direction, direction);
    Tensor<2, dim>       result =
      along_normal + cut * (identity - along_normal - along_friction);
    if (limit.increases_at(found.normal, slip))
      result += limit.coefficient * outer_product(direction, normal);
    return stiffness * result +
           limit.slope(found.normal, slip) * along_friction;
  }



  /// Bit d stands for component d. Slipping nodes are held along the normal
  /// only, open nodes only by walls.
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
    for (const Place &place : places_.all())
      for (unsigned int d = 0; d < dim; ++d)
        if (place.stiffness == 0 && place.state != State::open &&
            (place.state == State::sticks || place.normal[d] != 0))
          result[place.node[0]] |= 1u << d;
    return result;
  }



  template <int dim>
  void
  StaticContact<dim>::add_forces(const double               factor,
                                 const std::vector<double> &u,
                                 std::vector<double>       &forces)
  {
    for (Place &place : places_)
      {
        place.find_force(u);
        place.distribute(factor * place.force(), forces);
      }
  }



  template <int dim>
  void
  StaticContact<dim>::add_pressure(
    const std::function<double(const Point<dim> &)> &pressure,
    std::vector<double>                             &forces) const
  {
    for (const Place &place : places_.all())
      if (place.area > 0.)
        place.distribute(pressure(place.centroid) * place.area * place.normal,
                         forces);
  }



  template <int dim>
  void
  StaticContact<dim>::couple(StiffnessMatrix<dim> &matrix) const
  {
    for (const Place &place : places_.all())
      if (place.stiffness > 0)
        matrix.couple({place.node.data(), place.n_nodes});
  }



  template <int dim>
  void
  StaticContact<dim>::add_to_matrix(StiffnessMatrix<dim> &matrix)
  {
    FullMatrix<double> block;
    for (Place &place : places_)
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



  /// Update the state of a node on a face of the mesh after a solution, by the
  /// rules
  ///   open    -> sticks  if soil has moved into the face;
  ///   any     -> open    if the face would have to pull;
  ///   sticks  -> slips   if the force along the face exceeds the largest
  ///                      friction, which then acts in the same direction;
  ///   slips   -> sticks  if the node moved along the friction.
  /// The friction of a slipping node follows the normal force, and its change
  /// counts as a change of state. The direction of slip is kept from the start
  /// of slip; in 2-D there is only one. Components of @p reaction, N, along the
  /// axes of @p walls (bit d for axis d) are not friction. Forces are compared
  /// with the slack @p tolerance, N, so that round-off does not change states
  /// for ever.
  template <int dim>
  bool
  StaticContact<dim>::Place::update_held(const Tensor<1, dim>      &reaction,
                                         const unsigned char        walls,
                                         const std::vector<double> &u,
                                         const double               tolerance)
  {
    const State          old_state    = state;
    const Tensor<1, dim> old_friction = found.tangential;
    const Tensor<1, dim> moved        = displacement(u);
    if (state == State::open)
      state = (moved * normal < 0. ? State::sticks : State::open);
    else if (reaction * normal < -tolerance)
      {
        state = State::open;
        given = {};
      }
    else
      {
        given.normal          = std::max(reaction * normal, 0.);
        const double friction = limit.force(given.normal);
        if (state == State::sticks)
          {
            given.tangential = reaction - (reaction * normal) * normal;
            for (unsigned int d = 0; d < dim; ++d)
              if (walls & (1u << d))
                given.tangential[d] = 0.;
            if (given.tangential.norm() > friction + tolerance)
              state = State::slips;
          }
        else if (moved * given.tangential > 0.)
          state = State::sticks;
        if (const double length = given.tangential.norm();
            state == State::slips && length > 0.)
          given.tangential *= friction / length;
      }
    find_force(u);
    return state != old_state ||
           (state == State::slips &&
            (found.tangential - old_friction).norm() > tolerance);
  }



  /// The negative residual is the change of the force at held components. Free
  /// components hold the residual left by Newton's method.
  template <int dim>
  unsigned int
  StaticContact<dim>::update_held(const StaticProblem<dim>  &problem,
                                  const Unknowns<dim>       &unknowns,
                                  const std::vector<double> &residual,
                                  std::vector<double>       &u)
  {
    std::vector<double> reactions = unknowns.field();
    for (const Place &place : places_.all())
      if (place.stiffness == 0)
        place.distribute(place.force(), reactions);
    unsigned int n_changes = 0;
    for (Place &place : places_)
      if (place.stiffness == 0 && place.n_nodes > 0)
        {
          const unsigned int node = place.node[0];
          Tensor<1, dim>     reaction;
          for (unsigned int d = 0; d < dim; ++d)
            reaction[d] = reactions[dim * node + d] - residual[dim * node + d];
          // Force at the node plus weight of its soil, as either may be zero.
          const double weight =
            reaction.norm() +
            unknowns.mass(node) * problem.loads.acceleration_of_body[0].norm();
          const bool was_open = (place.state == State::open);
          if (!place.update_held(
                reaction,
                problem.boundaries.components_constrained_by_walls(
                  problem.state.grid.faces_of_node(node)),
                u,
                1e-6 * weight))
            continue;
          ++n_changes;
          // The next loop holds the normal displacement at zero: on the face.
          for (unsigned int d = 0; d < dim; ++d)
            if (was_open && place.normal[d] != 0)
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
    for (Place &place : places_)
      if (place.stiffness > 0)
        {
          const double change =
            std::abs(place.found.normal - place.given.normal) +
            (place.found.tangential - place.given.tangential).norm();
          sums[0] += place.area;
          sums[1] += place.area * std::pow(change / place.stiffness, 2);
          sums[2] += change;
          sums[3] += place.found.normal + place.found.tangential.norm();
          place.given = place.found;
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
    for (Place &place : places_)
      if (place.state == State::slips && !place.sticks_first &&
          place.found.tangential * place.displacement(direction) > 0)
        {
          place.state        = State::sticks;
          place.sticks_first = true;
          ++n_changes;
        }
    return Utilities::MPI::sum(n_changes, unknowns.communicator());
  }



  /// At small strain points do not move, so the motion of the soil towards the
  /// obstacle must be remembered.
  template <int dim>
  void
  StaticContact<dim>::commit(const StaticProblem<dim>  &problem,
                             const std::vector<double> &u,
                             const StrainMeasure        measure)
  {
    const auto                    &facets = problem.contact.constraints().all();
    std::vector<FacetImpulse<dim>> forces;
    for (Place &place : places_)
      {
        place.given = place.found;
        if (place.slip > 0)
          (place.stiffness > 0 ? problem.contact.slip()
                               : problem.boundaries.seabed().slip())
            .add(place.number_in_bed, place.slip);
        place.opened = (measure == StrainMeasure::small
                          ? place.opened + place.displacement(u) * place.normal
                          : 0.);
        if (const unsigned int k = forces.size(); k < facets.size())
          forces.push_back({place.found.normal,
                            place.found.tangential,
                            place.stiffness > 0 ? facets[k].mass : 0.,
                            place.found.normal});
      }
    if (!problem.contact.obstacles().empty())
      problem.contact.set_forces(forces);
  }



  template class StaticContact<2>;
  template class StaticContact<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/static_facets.h>
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

    // Largest number of loops. Forces that alternate from facet to facet hardly
    // move the soil: they converge slowly and need not converge.
    constexpr unsigned int max_loops = 5;

    // Slack for the round-off of forces cut to the friction.
    constexpr double slack = 1. + 1e-12;
  } // namespace



  template <int dim>
  void
  StaticFacets<dim>::begin(const StaticProblem<dim> &problem,
                           const Unknowns<dim>      &unknowns,
                           const double              modulus)
  {
    n_loops_      = 0;
    is_symmetric_ = true;
    for (unsigned int k = 0; k < problem.contact.obstacles().size(); ++k)
      is_symmetric_ = is_symmetric_ &&
                      problem.contact.obstacles()[k].bed().coefficient() == 0;
    if (problem.contact.obstacles().empty())
      return;
    n_facets_                     = problem.contact.facets().owned().size();
    std::vector<PlaceKey> places  = keys_of(problem.contact.facets().owned());
    const auto            of_node = keys_of_owned_nodes(problem.state.grid);
    for (const auto &inside : problem.contact.facets().nodes_inside())
      places.push_back(place_key(of_node[inside.node], inside.obstacle, -1.));
    points_.update(std::move(places));
    set_facets(problem, modulus);
    set_nodes_inside(problem, unknowns, modulus);
    for (ContactPoint &point : points_)
      {
        if (point.given.normal > 0)
          point.gap = 0;
        // Soil new at an obstacle has no normal force yet, and hence no
        // friction.
        point.sticks_first = (point.given.normal == 0);
        find_force(point, {});
      }
  }



  /// Set all facets, also without soil, so that the numbers of facets are kept.
  template <int dim>
  void
  StaticFacets<dim>::set_facets(const StaticProblem<dim> &problem,
                                const double              modulus)
  {
    const auto &facets = problem.contact.facets().owned();
    for (unsigned int k = 0; k < n_facets_; ++k)
      {
        const auto   &constraint = problem.contact.constraints()[k];
        const auto   &impulse    = problem.contact.impulses()[k];
        ContactPoint &point      = points_[k];
        point.node               = facets[k].node;
        point.share              = constraint.share;
        point.normal             = facets[k].normal;
        if (!constraint.is_loaded)
          {
            point.opened = 0;
            continue;
          }
        point.place     = facets[k].centroid;
        point.area      = constraint.area;
        point.stiffness = spring * modulus * constraint.area /
                          problem.state.grid.cells()[facets[k].cell].size;
        point.limit = problem.contact.constraints().limit(k);
        point.given = {impulse.normal, impulse.tangential};
        point.gap   = std::max(0., constraint.gap + point.opened);
      }
  }



  /// Set nodes inside obstacles, as in the dynamics: without area and so
  /// without friction.
  template <int dim>
  void
  StaticFacets<dim>::set_nodes_inside(const StaticProblem<dim> &problem,
                                      const Unknowns<dim>      &unknowns,
                                      const double              modulus)
  {
    const Grid<dim> &grid = problem.state.grid;
    const double     h    = grid.finest_size();
    unsigned int     k    = n_facets_;
    for (const auto &inside : problem.contact.facets().nodes_inside())
      {
        ContactPoint &point = points_[k++];
        point.node.fill(inside.node);
        point.share.fill(0.);
        point.share[0] = 1.;
        point.normal =
          problem.contact.obstacles()[inside.obstacle].normal(inside.place);
        if (!unknowns.is_active(inside.node))
          {
            point.opened = 0;
            continue;
          }
        point.stiffness =
          spring * modulus * unknowns.volume(inside.node) / (h * h);
        point.given.normal = point.found.normal;
        point.gap =
          std::max(0.,
                   problem.contact.constraints().gap_inside(grid, inside) +
                     point.opened);
      }
  }



  /// Displacement of the contact point, m; zero if @p u is empty.
  template <int dim>
  Tensor<1, dim>
  StaticFacets<dim>::displacement(const ContactPoint        &point,
                                  const std::vector<double> &u) const
  {
    Tensor<1, dim> result;
    if (!u.empty())
      for (unsigned int v = 0; v < n_nodes; ++v)
        if (point.share[v] > 0)
          for (unsigned int d = 0; d < dim; ++d)
            result[d] +=
              point.share[v] * u[std::size_t(dim) * point.node[v] + d];
    return result;
  }



  // With the gap g, the displacement u and the spring k,
  //   N = max(0, N_given - k (g + u n)),
  //   T = T_given - k (u - (u n) n), cut to min(mu N, tau_max A).
  // A point that slips has slipped by its displacement along the surface: at
  // the end of the loops the spring is not deformed.
  template <int dim>
  void
  StaticFacets<dim>::find_force(ContactPoint              &point,
                                const std::vector<double> &u) const
  {
    point.found     = {};
    point.is_closed = point.slips = false;
    point.slip                    = 0;
    if (point.stiffness == 0)
      return;
    const Tensor<1, dim> d   = displacement(point, u);
    const double         d_n = d * point.normal;
    const double         normal =
      point.given.normal - point.stiffness * (point.gap + d_n);
    if (normal < 0)
      return;
    point.is_closed          = true;
    point.found.normal       = normal;
    const Tensor<1, dim> d_t = d - d_n * point.normal;
    const Tensor<1, dim> tangential =
      point.given.tangential - point.stiffness * d_t;
    const double length   = tangential.norm();
    double       friction = point.limit.force(normal);
    point.slips           = (friction == 0 || length > friction * slack);
    if (point.slips && friction > 0 && point.limit.softens())
      {
        point.slip = d_t.norm();
        friction   = point.limit.force(normal, point.slip);
      }
    if (point.slips && length > 0)
      point.direction = tangential / length;
    point.cut = (point.slips && length > 0 ? friction / length : 0.);
    point.found.tangential =
      (point.slips ? friction * point.direction : tangential);
  }



  /// Negative derivative of the force by the displacement, N/m. While the point
  /// slips, the friction is mu N or its cap in the direction of slip, and the
  /// direction turns with the slip.
  template <int dim>
  Tensor<2, dim>
  StaticFacets<dim>::tangent(const ContactPoint &point) const
  {
    const Tensor<2, dim> identity = unit_symmetric_tensor<dim>();
    if (!point.is_closed)
      return Tensor<2, dim>();
    if (!point.slips || point.sticks_first)
      return point.stiffness * identity;
    const Tensor<2, dim> along_normal =
      outer_product(point.normal, point.normal);
    Tensor<2, dim> result =
      along_normal +
      point.cut * (identity - along_normal -
                   outer_product(point.direction, point.direction));
    if (point.limit.increases_at(point.found.normal, point.slip))
      result +=
        point.limit.coefficient * outer_product(point.direction, point.normal);
    result *= point.stiffness;
    if (point.limit.softens())
      result += point.limit.slope(point.found.normal, point.slip) *
                outer_product(point.direction, point.direction);
    return result;
  }



  template <int dim>
  void
  StaticFacets<dim>::add_forces(const double               factor,
                                const std::vector<double> &u,
                                std::vector<double>       &forces)
  {
    for (ContactPoint &point : points_)
      {
        find_force(point, u);
        if (!point.is_closed)
          continue;
        const Tensor<1, dim> force =
          factor * (point.found.normal * point.normal + point.found.tangential);
        for (unsigned int v = 0; v < n_nodes; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            forces[std::size_t(dim) * point.node[v] + d] +=
              point.share[v] * force[d];
      }
  }



  template <int dim>
  void
  StaticFacets<dim>::add_pressure(
    const std::function<double(const Point<dim> &)> &pressure,
    std::vector<double>                             &forces) const
  {
    for (const ContactPoint &point : points_.all())
      if (point.area > 0.)
        {
          const Tensor<1, dim> force =
            pressure(point.place) * point.area * point.normal;
          for (unsigned int v = 0; v < n_nodes; ++v)
            for (unsigned int d = 0; d < dim; ++d)
              forces[std::size_t(dim) * point.node[v] + d] +=
                point.share[v] * force[d];
        }
  }



  namespace
  {
    /// List the nodes with a weight, and their indices in the contact point.
    template <typename ContactPoint>
    void
    list_nodes(const ContactPoint        &point,
               std::vector<unsigned int> &nodes,
               std::vector<unsigned int> &vertices)
    {
      nodes.clear();
      vertices.clear();
      for (unsigned int v = 0; v < point.share.size(); ++v)
        if (point.stiffness > 0 && point.share[v] > 0)
          {
            nodes.push_back(point.node[v]);
            vertices.push_back(v);
          }
    }
  } // namespace



  template <int dim>
  void
  StaticFacets<dim>::couple(StiffnessMatrix<dim> &matrix) const
  {
    std::vector<unsigned int> nodes, vertices;
    for (const ContactPoint &point : points_.all())
      {
        list_nodes(point, nodes, vertices);
        matrix.couple(nodes);
      }
  }



  template <int dim>
  void
  StaticFacets<dim>::add_to_matrix(StiffnessMatrix<dim> &matrix)
  {
    std::vector<unsigned int> nodes, vertices;
    FullMatrix<double>        block;
    for (ContactPoint &point : points_)
      {
        const Tensor<2, dim> k = tangent(point);
        point.sticks_first     = false;
        if (!point.is_closed)
          continue;
        list_nodes(point, nodes, vertices);
        const unsigned int n = dim * nodes.size();
        block.reinit(n, n);
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            block(i, j) = point.share[vertices[i / dim]] *
                          point.share[vertices[j / dim]] * k[i % dim][j % dim];
        matrix.add(nodes, block);
      }
  }



  // The remaining force of a spring over its stiffness is the distance that the
  // soil moved against the contact. The mean is weighted by area, so that
  // slivers, whose springs are soft, do not dominate. If the forces hardly
  // change, displacements are round-off and no measure of the error.
  template <int dim>
  bool
  StaticFacets<dim>::update(const StaticProblem<dim>  &problem,
                            const Unknowns<dim>       &unknowns,
                            const std::vector<double> &u,
                            const double               tolerance)
  {
    if (problem.contact.obstacles().empty())
      return true;
    // Area, area times error squared, change of forces, forces.
    std::vector<double> sums(4, 0.);
    for (ContactPoint &point : points_)
      {
        if (point.stiffness == 0)
          continue;
        const double change =
          std::abs(point.found.normal - point.given.normal) +
          (point.found.tangential - point.given.tangential).norm();
        sums[0] += point.area;
        sums[1] += point.area * std::pow(change / point.stiffness, 2);
        sums[2] += change;
        sums[3] += point.found.normal + point.found.tangential.norm();
        point.given = point.found;
      }
    const MPI_Comm communicator = unknowns.communicator();
    Utilities::MPI::sum(sums, communicator, sums);
    double largest = 0;
    for (const double x : u)
      largest = std::max(largest, std::abs(x));
    largest = Utilities::MPI::max(largest, communicator);
    return ++n_loops_ >= max_loops ||
           std::sqrt(sums[1]) <= tolerance * largest * std::sqrt(sums[0]) ||
           sums[2] <= 1e-9 * sums[3];
  }



  /// As at nodes on the seabed, friction reverses as soon as the soil moves
  /// along it. The tangent of sticking keeps the next iterate from being a
  /// mechanism; the force stays cut to the friction.
  template <int dim>
  unsigned int
  StaticFacets<dim>::stick_again(const std::vector<double> &direction)
  {
    unsigned int n_changes = 0;
    for (ContactPoint &point : points_)
      if (point.slips && !point.sticks_first &&
          point.found.tangential * displacement(point, direction) > 0)
        {
          point.sticks_first = true;
          ++n_changes;
        }
    return n_changes;
  }



  /// At small strain points do not move, so the motion of the soil towards the
  /// obstacle must be remembered.
  template <int dim>
  void
  StaticFacets<dim>::commit(const StaticProblem<dim>  &problem,
                            const std::vector<double> &u,
                            const StrainMeasure        measure)
  {
    if (problem.contact.obstacles().empty())
      return;
    std::vector<FacetImpulse<dim>> forces;
    for (unsigned int k = 0; k < points_.size(); ++k)
      {
        ContactPoint &point = points_[k];
        if (point.slip > 0)
          problem.contact.slip().add(k, point.slip);
        const double moved = displacement(point, u) * point.normal;
        point.opened =
          (measure == StrainMeasure::small ? point.opened + moved : 0.);
        if (k < n_facets_)
          forces.push_back(
            {point.found.normal,
             point.found.tangential,
             point.stiffness > 0 ? problem.contact.constraints()[k].mass : 0.,
             point.found.normal});
      }
    problem.contact.set_forces(forces);
  }



  template class StaticFacets<2>;
  template class StaticFacets<3>;
} // namespace talus

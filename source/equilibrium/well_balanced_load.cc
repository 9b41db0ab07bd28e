// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/internal_forces.h>
#include <talus/equilibrium/well_balanced_load.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Bounds of E as fractions of the weight of a full cell, and of the
    // pressure on its side. Errors of quadrature stay below a third of the
    // bounds. A larger force comes from a pressure without support.
    constexpr double share_of_weight = 0.3, share_of_pressure = 0.15;
  } // namespace



  /// Return whether points and nodes are those of the last call on all ranks,
  /// and remember them. Collective.
  template <int dim>
  bool
  WellBalancedLoad<dim>::is_current(const Points<dim>   &points,
                                    const Unknowns<dim> &unknowns)
  {
    std::vector<Point<dim>> place;
    for (unsigned int p = 0; p < points.size(); ++p)
      place.push_back(load_place(points, points.position, p));
    const bool changes = place != place_ || unknowns.active_nodes() != nodes_;
    place_             = std::move(place);
    nodes_             = unknowns.active_nodes();
    return !Utilities::MPI::logical_or(changes, unknowns.communicator());
  }



  namespace
  {
    /// Return a function that calls @p height at most once per vertical: points
    /// of a lattice share verticals, and each search for the mudline takes some
    /// 30 us.
    template <int dim>
    std::function<double(const Point<dim> &)>
    with_memory(const std::function<double(const Point<dim> &)> &height)
    {
      const auto heights =
        std::make_shared<std::map<std::pair<double, double>, double>>();
      return [=](const Point<dim> &x) {
        const auto [entry, is_new] =
          heights->try_emplace({x[0], dim == 3 ? x[dim - 1] : 0.}, 0.);
        if (is_new)
          entry->second = height(x);
        return entry->second;
      };
    }
  } // namespace



  /// Compute
  ///   E_i = sum_p V (p' grad S_ip + S_ip grad p) + sum_f share_if p A n,
  /// with p' after the mean of B-bar and facet normals n into the soil.
  template <int dim>
  void
  WellBalancedLoad<dim>::update(const StaticProblem<dim>      &given,
                                const ShapeFunctionCache<dim> &weights,
                                const StaticContact<dim>      &contact,
                                Unknowns<dim>                 &unknowns)
  {
    if (is_current(given.state.points, unknowns))
      return;
    forces_.clear();
    n_nodes_without_ = 0;
    if (!given.mudline || has_moved(given))
      return;
    StaticProblem<dim> problem = given;
    problem.mudline            = with_memory<dim>(given.mudline);
    unit_weight_               = mean_unit_weight(problem);
    if (!(unit_weight_ > 0.))
      return;
    find_pressure(problem);
    forces_ = unknowns.field();
    InternalForces<dim> internal;
    internal.add_forces_of_pressure(problem, weights, pressure_, forces_);
    for (double &force : forces_)
      force = -force;
    add_pressure_gradient(weights);
    contact.add_pressure(
      [&](const Point<dim> &x) {
        const double height = problem.mudline(x);
        return height > x[1] ? unit_weight_ * (height - x[1]) : 0.;
      },
      forces_);
    unknowns.add_to_owners(forces_);
    leave_walls_alone(problem, unknowns);
    leave_free_faces_alone(problem, weights, unknowns);
  }



  /// Return whether the soil has left its initial mudline: the mean
  /// displacement of the points, weighted by mass, exceeds a tenth of the
  /// smallest cell. Collective.
  template <int dim>
  bool
  WellBalancedLoad<dim>::has_moved(const StaticProblem<dim> &problem) const
  {
    const Points<dim>  &points = problem.state.points;
    std::vector<double> sums(2, 0.); // mass times way, mass
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double mass = points.data(points.mass)[p];
        sums[0] +=
          mass * load_place(points, points.position, p)
                   .distance(load_place(points, points.initial_position, p));
        sums[1] += mass;
      }
    Utilities::MPI::sum(sums, problem.state.grid.communicator(), sums);
    return sums[0] > 0.1 * problem.state.grid.finest_size() * sums[1];
  }



  /// Component along -y of the weight of all soil over its volume, N/m^dim. A
  /// single value for all bodies keeps p continuous between bodies. Collective.
  template <int dim>
  double
  WellBalancedLoad<dim>::mean_unit_weight(
    const StaticProblem<dim> &problem) const
  {
    const Points<dim>  &points = problem.state.points;
    std::vector<double> sums(2, 0.); // weight, volume
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      sums[0] -= points.data(points.mass)[p] *
                 problem.loads.acceleration_of_body[segment.body][1];
      sums[1] += volume_of_points<dim, double>(points, p);
    });
    Utilities::MPI::sum(sums, problem.state.grid.communicator(), sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }



  /// Compute the pressure at the centres of the boxes, and its gradient: exact
  /// along y, along all further axes as a mean over the width of the box.
  template <int dim>
  void
  WellBalancedLoad<dim>::find_pressure(const StaticProblem<dim> &problem)
  {
    const Points<dim> &points = problem.state.points;
    volume_.resize(points.size());
    pressure_.resize(points.size());
    gradient_.resize(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        volume_[p]          = volume_of_points<dim, double>(points, p);
        const auto   x      = load_place(points, points.position, p);
        const double height = problem.mudline(x);
        // Also true if the height is not a number.
        if (!(height > x[1]))
          continue;
        pressure_[p] = unit_weight_ * (height - x[1]);
        for (unsigned int d = 0; d < dim; ++d)
          gradient_[p][d] =
            unit_weight_ * (d == 1 ? -1. : mean_slope(problem, p, d, height));
      }
  }



  /// Mean slope of the mudline along axis @p d over the width of the box of
  /// point @p p, within the mesh [-]. @p height is the height at the centre, m.
  /// Near the tip of a layer some verticals have no soil: then a smaller width
  /// is used, or one side of the centre only.
  template <int dim>
  double
  WellBalancedLoad<dim>::mean_slope(const StaticProblem<dim> &problem,
                                    const unsigned int        p,
                                    const unsigned int        d,
                                    const double              height) const
  {
    const Points<dim> &points     = problem.state.points;
    const Box<dim>    &domain     = problem.state.grid.domain();
    const auto         x          = load_place(points, points.position, p);
    double             half_width = 0.5 * points.data(points.box_length, d)[p];
    for (unsigned int k = 0; k < 5; ++k, half_width *= 0.5)
      {
        Point<dim> lower = x, upper = x;
        lower[d] = std::max(x[d] - half_width, domain.lower[d]);
        upper[d] = std::min(x[d] + half_width, domain.upper[d]);
        const double lower_height = problem.mudline(lower);
        const double upper_height = problem.mudline(upper);
        if (!std::isnan(lower_height) && !std::isnan(upper_height))
          return (upper_height - lower_height) / (upper[d] - lower[d]);
        if (k == 4 && !std::isnan(lower_height))
          return (height - lower_height) / (x[d] - lower[d]);
        if (k == 4 && !std::isnan(upper_height))
          return (upper_height - height) / (upper[d] - x[d]);
      }
    return 0.;
  }



  template <int dim>
  void
  WellBalancedLoad<dim>::add_pressure_gradient(
    const ShapeFunctionCache<dim> &weights)
  {
    weights.for_each_weight(
      [&](const unsigned int p, const unsigned int node, const double weight) {
        for (unsigned int d = 0; d < dim; ++d)
          forces_[dim * std::size_t(node) + d] +=
            volume_[p] * weight * gradient_[p][d];
      });
  }



  /// At faces of the mesh that are not free, the reaction bears p, and friction
  /// needs the full reaction. Hence E has no normal component at the face.
  template <int dim>
  void
  WellBalancedLoad<dim>::leave_walls_alone(const StaticProblem<dim> &problem,
                                           const Unknowns<dim>      &unknowns)
  {
    for (const unsigned int node : unknowns.active_nodes())
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (problem.state.grid.faces_of_node(node) & (1u << face) &&
            !problem.boundaries.is_free(face))
          forces_[dim * std::size_t(node) + face / 2] = 0.;
  }



  /// Largest E that may be an error of quadrature, N, by node: the bound of the
  /// cell averaged over the points around the node, weighted by volume. Stored
  /// in the first of the dim components at each node. Collective.
  template <int dim>
  std::vector<double>
  WellBalancedLoad<dim>::largest_errors(const StaticProblem<dim>      &problem,
                                        const ShapeFunctionCache<dim> &weights,
                                        Unknowns<dim> &unknowns) const
  {
    const Points<dim>  &points = problem.state.points;
    std::vector<double> error(points.size()); // by point, N
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      const double h = problem.state.grid.cells()[segment.cell].size;
      error[p]       = (share_of_weight * unit_weight_ * h +
                  share_of_pressure * pressure_[p]) *
                 std::pow(h, dim - 1);
    });
    std::vector<double> sums = unknowns.field(); // error S V, S V
    weights.for_each_weight(
      [&](const unsigned int p, const unsigned int node, const double weight) {
        double *sum = &sums[dim * std::size_t(node)];
        sum[0] += volume_[p] * weight * error[p];
        sum[1] += volume_[p] * weight;
      });
    unknowns.add_to_owners(sums);
    for (std::size_t i = 0; i < sums.size(); i += dim)
      sums[i] = (sums[i + 1] > 0. ? sums[i] / sums[i + 1] : 0.);
    return sums;
  }



  /// Without support of p, E is about p times the side of a cell, more than any
  /// error of quadrature. Points next to the free face pass a smaller part to
  /// their further nodes; E is not subtracted there either. Collective.
  template <int dim>
  void
  WellBalancedLoad<dim>::leave_free_faces_alone(
    const StaticProblem<dim>      &problem,
    const ShapeFunctionCache<dim> &weights,
    Unknowns<dim>                 &unknowns)
  {
    const auto          limits   = largest_errors(problem, weights, unknowns);
    std::vector<double> is_large = unknowns.field(), touches = is_large;
    for (const unsigned int node : unknowns.active_nodes())
      {
        const std::size_t i      = dim * std::size_t(node);
        double            square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          square += forces_[i + d] * forces_[i + d];
        if (std::sqrt(square) > limits[i])
          is_large[i] = 1.;
      }
    unknowns.copy_to_ghosts(is_large);
    std::vector<double> largest(volume_.size(), 0.); // by point
    weights.for_each_weight(
      [&](const unsigned int p, const unsigned int node, const double weight) {
        if (weight > 0.)
          largest[p] = std::max(largest[p], is_large[dim * std::size_t(node)]);
      });
    weights.for_each_weight(
      [&](const unsigned int p, const unsigned int node, const double weight) {
        if (weight > 0.)
          touches[dim * std::size_t(node)] += largest[p];
      });
    unknowns.add_to_owners(touches);
    for (const unsigned int node : unknowns.active_nodes())
      if (const std::size_t i = dim * std::size_t(node);
          touches[i] + is_large[i] > 0.)
        {
          std::fill_n(forces_.begin() + i, dim, 0.);
          ++n_nodes_without_;
        }
    n_nodes_without_ =
      Utilities::MPI::sum(n_nodes_without_, unknowns.communicator());
  }



  template class WellBalancedLoad<2>;
  template class WellBalancedLoad<3>;
} // namespace talus

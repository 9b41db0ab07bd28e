// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/damping.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Damping<dim>::Damping(const Boundaries<dim>            &boundaries,
                        const std::vector<unsigned char> &feels_obstacle)
    : ParameterAcceptor("/Damping")
    , boundaries_(boundaries)
    , feels_obstacle_(feels_obstacle)
  {
    add_parameter("Local damping",
                  coefficient_,
                  "For quasi-static problems: share of the unbalanced force of "
                  "a node, by component, that acts against the motion "
                  "[-]; 0 for none. Common values are 0.1 to 0.8. Damping "
                  "falsifies the runout of a slide and so needs Output/Runout "
                  "= false.",
                  this->prm,
                  Patterns::Double(0., 0.99));
  }



  // Damping acts by impulses, like boundaries, so that the energy budget
  // closes. The work uses the mean velocity after damping, w' = w - change/2.
  // The limit 2 |w| of the change prevents a reversal of w, so the work is
  // never negative.
  template <int dim>
  double
  Damping<dim>::apply(NodalFields<dim> &nodes,
                      const Grid<dim>  &grid,
                      const double      mass_cutoff) const
  {
    double work = 0;
    if (coefficient_ == 0)
      return work;
    for (const unsigned int node : nodes.active_nodes())
      if (nodes.mass(node) > mass_cutoff &&
          (feels_obstacle_.empty() || !feels_obstacle_[node]))
        {
          const unsigned char faces = grid.faces_of_node(node);
          const unsigned char held =
            (faces == 0 ? 0 : boundaries_.constrained_components(faces));
          const Tensor<1, dim> mean = nodes.mean_velocity(node);
          Tensor<1, dim>       v    = nodes.velocity(node);
          for (unsigned int d = 0; d < dim; ++d)
            // A boundary bears the force on held components: with damping, a
            // slope would have less friction.
            if (!(held & (1u << d)))
              {
                // dt f/m = 2 (v - mean); the mean changes by half the change of
                // v.
                const double change =
                  std::min(coefficient_ * 2. * std::abs(v[d] - mean[d]),
                           2. * std::abs(mean[d]));
                v[d] -= std::copysign(change, mean[d]);
              }
          const Tensor<1, dim> impulse = nodes.set_velocity(node, v);
          work -= impulse * nodes.mean_velocity(node);
        }
    return work;
  }



  template class Damping<2>;
  template class Damping<3>;
} // namespace talus

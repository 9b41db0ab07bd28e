// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_geostatic_h
#define talus_problem_geostatic_h

#include <talus/base/remark.h>
#include <talus/contact/ground.h>
#include <talus/materials/materials.h>
#include <talus/problem/body.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>
#include <vector>

namespace talus
{
  /// Return the mass per area above the centre of each point, kg/m^2, along y,
  /// from the undeformed boxes of the points of all bodies. The result is the
  /// mean over the width of the point's box: bodies with different numbers of
  /// points per cell, and cells of different sizes, may lie above one another.
  /// The masses of the points count, not the shapes, as in the weight on the
  /// grid. Independent of the number of ranks. Collective; each rank
  /// temporarily holds the boxes of all points.
  /// @param weight_density density for the weight of each body, kg/m^3
  template <int dim>
  std::vector<double>
  overburden(const Points<dim>         &points,
             const std::vector<double> &weight_density,
             MPI_Comm                   communicator);

  /// Return the stress across the layers along the @p ground at rest at each
  /// point, -g_n M n_y, Pa, compression positive; see set_geostatic_stress().
  /// Collective.
  template <int dim>
  std::vector<double>
  normal_stress_at_rest(const Points<dim>            &points,
                        const std::vector<double>    &weight_density,
                        const dealii::Tensor<1, dim> &gravity,
                        const Ground<dim>            &ground,
                        MPI_Comm                      communicator);

  /// Set the K0 stress of the points of bodies with `K0`: soil at rest under
  /// its own weight in layers along the @p ground, with @p gravity g, m/s^2,
  /// normal n of the layers and M n_y the overburden() per area of the layer:
  ///   s_nn = g_n M n_y + u,  s_tt = s_zz = K0 s_nn,  s_tn = g_t M n_y,
  /// effective with the excess pore pressure u of the points,
  /// in equilibrium in level ground and in an infinite slope; on the bottom of
  /// the mesh also on the grid, down to round-off. Throws ExcUser if a body is
  /// displaced or there is no gravity. Collective.
  template <int dim>
  void
  set_geostatic_stress(Points<dim>                                   &points,
                       const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                       const Materials<dim>                          &materials,
                       const dealii::Tensor<1, dim>                  &gravity,
                       const Ground<dim>                             &ground,
                       MPI_Comm communicator);

  /// Return remarks on K0 stress above the strength. Collective.
  template <int dim>
  std::vector<Remark>
  notes_on_stress_at_rest(const Points<dim>                             &points,
                          const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                          const Materials<dim> &materials,
                          MPI_Comm              communicator);

  /// Return notes on bodies of undrained soil without stress at the start, or
  /// with a pore pressure that @p changes.
  template <int dim>
  std::vector<Remark>
  notes_on_undrained_soil(const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                          const Materials<dim> &materials,
                          bool                  changes);
} // namespace talus

#endif

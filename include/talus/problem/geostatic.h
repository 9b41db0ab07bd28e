// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_geostatic_h
#define talus_problem_geostatic_h

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
  /// Mass per area that lies above the centre of each point, kg/m^2 (along y,
  /// by the undeformed boxes of the points of all bodies), with
  /// @p weight_density of each body, kg/m^3. It is the mean over the width of
  /// the point's box, so that bodies with other numbers of points per cell, and
  /// cells of other sizes, may lie above one another. What the points carry is
  /// counted, not what the shapes enclose: this is the weight that the grid
  /// feels. The result does not depend on the number of ranks. Collective; each
  /// rank holds the boxes of all for that time.
  template <int dim>
  std::vector<double>
  overburden(const Points<dim>         &points,
             const std::vector<double> &weight_density,
             MPI_Comm                   communicator);

  /// Give the points of the bodies that ask for it (`K0`) the stress of soil at
  /// rest under its own weight in layers along the @p ground, with @p gravity,
  /// m/s^2, n the normal of the layers and M n_y the overburden() by area of
  /// the layer:
  ///   s_nn = g_n M n_y,  s_tt = s_zz = K0 s_nn,  s_tn = g_t M n_y,
  /// which is in equilibrium in level ground and in an infinite slope; on the
  /// bottom of the mesh down to round-off also on the grid. Returns sentences
  /// for the log: where the stress is more than the soil bears. Throws ExcUser
  /// if a body is displaced or there is no gravity. Collective.
  template <int dim>
  std::vector<std::string>
  set_geostatic_stress(Points<dim>                                   &points,
                       const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                       const Materials<dim>                          &materials,
                       const dealii::Tensor<1, dim>                  &gravity,
                       const Ground<dim>                             &ground,
                       MPI_Comm communicator);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_layer_surfaces_h
#define talus_problem_layer_surfaces_h

#include <talus/problem/body.h>

#include <string>

namespace talus
{
  /// Compare the two surfaces of a body that is a layer, in a mesh that fills
  /// @p domain, at places @p cell_size apart, m. Throws ExcUser if the layer has
  /// no thickness anywhere. Returns a remark if its lower surface lies above its
  /// upper one somewhere; empty if not, and for bodies of other shapes.
  template <int dim>
  std::string
  check_layer_surfaces(const Body<dim> &body,
                       const Box<dim>  &domain,
                       double           cell_size);
} // namespace talus

#endif

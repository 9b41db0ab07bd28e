// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_layer_surfaces_h
#define talus_problem_layer_surfaces_h

#include <talus/problem/body.h>

#include <string>

namespace talus
{
  /// Compare the two surfaces of a body that is a layer, in a mesh that fills
  /// @p domain, at places @p cell_size apart, m. Throws ExcUser if the layer
  /// has no thickness anywhere. Returns a remark if the lower surface lies
  /// above the upper surface somewhere; empty otherwise, and for other shapes.
  template <int dim>
  std::string
  check_layer_surfaces(const Body<dim> &body,
                       const Box<dim>  &domain,
                       double           cell_size);
} // namespace talus

#endif

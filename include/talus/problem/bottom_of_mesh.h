// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_bottom_of_mesh_h
#define talus_problem_bottom_of_mesh_h

#include <talus/base/box.h>
#include <talus/contact/obstacles.h>

#include <string>

namespace talus
{
  /// Return a note for the log if a terrain among @p obstacles goes below the
  /// bottom of the mesh, which fills @p domain and has a free bottom face: soil
  /// is lost there. Places inside other obstacles are excluded; places are
  /// tested at distances of @p cell_size, m. Empty if there is no such place.
  template <int dim>
  std::string
  note_on_bottom(const Obstacles<dim> &obstacles,
                 const Box<dim>       &domain,
                 double                cell_size);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/face_nodes.h>
#include <talus/grid/node_places.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  FaceNodes<dim>::prepare(const Grid<dim> &grid)
  {
    nodes_.clear();
    const unsigned char seabed = boundaries_.seabed_faces();
    first_.assign(grid.n_owned_nodes(), numbers::invalid_unsigned_int);
    if (seabed == 0)
      return;
    const std::vector<unsigned long> keys = keys_of_owned_nodes(grid);
    for (unsigned int node = 0; node < keys.size(); ++node)
      {
        const unsigned char faces = grid.faces_of_node(node);
        if ((faces & seabed) == 0)
          continue;
        first_[node]         = nodes_.size();
        const Point<dim> x   = boundaries_.place_of(node);
        const double     cap = bed().maximum_shear_stress(x);
        for (unsigned int face = 0; face < 2 * dim; ++face)
          if (const FaceShare share = grid.face_share(face, node);
              (seabed & (1u << face)) && share.area > 0)
            nodes_.push_back(
              {node,
               face,
               place_key(keys[node], /*bed=*/0, face),
               x,
               share.area,
               share.volume,
               cap,
               boundaries_.components_constrained_by_walls(faces)});
      }
  }



  template class FaceNodes<2>;
  template class FaceNodes<3>;
} // namespace talus

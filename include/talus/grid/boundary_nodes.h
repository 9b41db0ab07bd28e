// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_boundary_nodes_h
#define talus_grid_boundary_nodes_h

#include <talus/grid/cell_cache.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// What a node on a face of the mesh stands for, hanging nodes condensed.
  struct FaceShare
  {
    /// Integral of its shape function over the face, m^(dim-1).
    double area = 0;
    /// Integral of its shape function over the cells at the face, m^dim.
    double volume = 0;
  };



  /// Which nodes lie on the faces of the mesh, and their shares in them.
  template <int dim>
  class BoundaryNodes
  {
  public:
    /// Bit f is set if the node lies on face f of the mesh.
    unsigned char
    faces_of_node(const unsigned int node) const
    {
      return faces_of_node_[node];
    }

    /// Share of node @p node, owned by this rank, in face @p face of the mesh.
    const FaceShare &
    face_share(const unsigned int face, const unsigned int node) const
    {
      return face_shares_[face].at(node);
    }

  protected:
    /// When cells and nodes are known. @p exchange has two doubles per node.
    /// Collective.
    void
    prepare_boundary(const MeshLayout<dim>    &layout,
                     const CellCache<dim>     &cells,
                     const NodeNumbering<dim> &nodes,
                     NodalExchange<dim>       &exchange);

  private:
    std::vector<unsigned char> faces_of_node_;
    std::array<std::unordered_map<unsigned int, FaceShare>, 2 * dim>
      face_shares_;
  };
} // namespace talus

#endif

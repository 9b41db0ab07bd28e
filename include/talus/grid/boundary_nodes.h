// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_boundary_nodes_h
#define talus_grid_boundary_nodes_h

#include <talus/grid/cell_cache.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Number of the lower face along y, the bottom of the mesh, in 2-D and 3-D.
  constexpr unsigned int bottom_face = 2;



  /// Part of a mesh face that a node represents. The share of a hanging node is
  /// distributed to its masters.
  struct FaceShare
  {
    /// Integral of the shape function over the face, m^(dim-1).
    double area = 0;
    /// Integral of the shape function over the cells at the face, m^dim.
    double volume = 0;
  };



  /// Nodes on the faces of the mesh, and their shares in the faces.
  template <int dim>
  class BoundaryNodes
  {
  public:
    /// Faces of the mesh that contain the node: bit f is set for face f.
    unsigned char
    faces_of_node(const unsigned int node) const
    {
      return faces_of_node_[node];
    }

    /// Share of an owned node in face @p face of the mesh: none for a hanging
    /// node, or a node that does not lie on the face.
    FaceShare
    face_share(const unsigned int face, const unsigned int node) const
    {
      const auto found = face_shares_[face].find(node);
      return found == face_shares_[face].end() ? FaceShare() : found->second;
    }

  protected:
    /// Find the nodes on the faces of the mesh and compute their shares. Cells
    /// and nodes must be prepared; @p exchange must carry two doubles per node.
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

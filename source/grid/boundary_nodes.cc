// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/boundary_nodes.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Cell with the faces of the mesh that the cell touches: bit f is set for
    /// face f.
    struct BoundaryCell
    {
      unsigned int  cell;
      unsigned char faces;
    };



    /// List the cells at the faces of the mesh, ascending. Periodic faces are
    /// no boundary.
    template <int dim>
    std::vector<BoundaryCell>
    find_boundary_cells(const MeshLayout<dim> &layout,
                        const CellCache<dim>  &cells)
    {
      std::vector<BoundaryCell> result;
      for (unsigned int c = 0; c < cells.cells().size(); ++c)
        {
          const auto place  = cells.place_of_cell(c);
          const auto extent = layout.extent_of_lattice(cells.level_of_cell(c));
          unsigned char faces = 0;
          for (unsigned int d = 0; d < dim; ++d)
            if (!layout.periodicity().along(d))
              faces |= (place[d] == 0) << (2 * d) | (place[d] == extent[d] - 1)
                                                      << (2 * d + 1);
          if (faces != 0)
            result.push_back({c, faces});
        }
      return result;
    }



    /// Nodes of a cell on face @p face of the mesh, which the cell must touch.
    template <int dim>
    std::array<unsigned int, power(2, dim - 1)>
    nodes_on_face(const Cell<dim> &cell, const unsigned int face)
    {
      std::array<unsigned int, power(2, dim - 1)> nodes;
      unsigned int                                n = 0;
      for (unsigned int v = 0; v < power(2, dim); ++v)
        if (((v >> (face / 2)) & 1) == face % 2)
          nodes[n++] = cell.patch[patch_of_vertex<dim>(v)];
      return nodes;
    }
  } // namespace



  // Shares are summed over the cells of all ranks. Shape functions are
  // bilinear, so the integral over a face of the cell is (size/2)^(dim-1), and
  // over the cell (size/2)^dim: no quadrature. Only the owner counts a cell.
  // The shares of hanging nodes go to their masters, as the forces do; the sum
  // over nodes remains the area of the face.
  template <int dim>
  void
  BoundaryNodes<dim>::prepare_boundary(const MeshLayout<dim>    &layout,
                                       const CellCache<dim>     &cells,
                                       const NodeNumbering<dim> &nodes,
                                       NodalExchange<dim>       &exchange)
  {
    const auto boundary_cells = find_boundary_cells(layout, cells);
    faces_of_node_.assign(nodes.n_nodes(), 0);
    for (const BoundaryCell &at : boundary_cells)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if ((at.faces >> face) & 1)
          for (const unsigned int node :
               nodes_on_face(cells.cells()[at.cell], face))
            faces_of_node_[node] |= 1u << face;

    AlignedVector<double> shares(2 * nodes.n_nodes());
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        shares.fill(0.);
        for (const BoundaryCell &at : boundary_cells)
          {
            if (at.cell >= cells.n_owned_cells() || !((at.faces >> face) & 1))
              continue;
            const Cell<dim> &cell   = cells.cells()[at.cell];
            const double     length = 0.5 * cell.size;
            const double     area   = std::pow(length, dim - 1.);
            for (const unsigned int node : nodes_on_face(cell, face))
              {
                shares[2 * node] += area;
                shares[2 * node + 1] += area * length;
              }
          }
        for (const auto &hanging : nodes.hanging_nodes())
          for (unsigned int i = 0; i < 2; ++i)
            {
              for (const auto &[master, weight] : hanging.masters)
                shares[2 * master + i] += weight * shares[2 * hanging.node + i];
              shares[2 * hanging.node + i] = 0;
            }
        exchange.add_to_owners(shares.data());
        face_shares_[face].clear();
        for (unsigned int node = 0; node < nodes.n_owned_nodes(); ++node)
          // Few nodes lie on a face: a table of all nodes would be nearly
          // empty.
          if (shares[2 * node] > 0)
            face_shares_[face][node] = {shares[2 * node], shares[2 * node + 1]};
      }
  }



  template class BoundaryNodes<2>;
  template class BoundaryNodes<3>;
} // namespace talus

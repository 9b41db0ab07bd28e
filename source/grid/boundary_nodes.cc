// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/boundary_nodes.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Nodes of cell @p c on face @p face of the mesh; none if the cell does
    /// not touch the face or the face is periodic, hence no boundary.
    template <int dim>
    std::vector<unsigned int>
    nodes_on_face(const MeshLayout<dim> &layout,
                  const CellCache<dim>  &cells,
                  const unsigned int     c,
                  const unsigned int     face)
    {
      const unsigned int d = face / 2, side = face % 2;
      const auto         place = cells.place_of_cell(c);
      const auto extent = layout.extent_of_lattice(cells.level_of_cell(c));
      if (layout.periodicity().along(d) ||
          place[d] != (side == 0 ? 0 : extent[d] - 1))
        return {};
      std::vector<unsigned int> nodes;
      for (unsigned int v = 0; v < power(2, dim); ++v)
        if (((v >> d) & 1) == side)
          nodes.push_back(cells.cells()[c].patch[patch_of_vertex<dim>(v)]);
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
    faces_of_node_.assign(nodes.n_nodes(), 0);
    for (unsigned int c = 0; c < cells.cells().size(); ++c)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        for (const unsigned int node : nodes_on_face(layout, cells, c, face))
          faces_of_node_[node] |= 1u << face;

    AlignedVector<double> shares(2 * nodes.n_nodes());
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        shares.fill(0.);
        for (unsigned int c = 0; c < cells.n_owned_cells(); ++c)
          {
            const double length = 0.5 * cells.cells()[c].size;
            const double area   = std::pow(length, dim - 1.);
            for (const unsigned int node :
                 nodes_on_face(layout, cells, c, face))
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

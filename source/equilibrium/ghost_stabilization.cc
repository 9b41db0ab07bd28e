// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/ghost_stabilization.h>

#include <deal.II/lac/full_matrix.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Volume fraction of soil at a node [-]: volume of soil near the node over
    /// the node's part of the mesh. An inner node has the volume of one cell;
    /// each face of the mesh through the node halves it. A node on a full wall
    /// thus has the volume fraction 1.
    template <int dim>
    double
    filling(const Grid<dim>     &grid,
            const Unknowns<dim> &unknowns,
            const unsigned int   node,
            const double         cell_volume)
    {
      double share = cell_volume;
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (grid.faces_of_node(node) & (1u << face))
          share *= 0.5;
      return unknowns.volume(node) / share;
    }
  } // namespace



  /// Each face belongs to the rank that owns the cell below. The rows of three
  /// nodes (below, on and above the face) are in the patch of the cell, 4^dim
  /// nodes, which is complete only in uniform cells: no face is stabilized
  /// where cell sizes change.
  ///
  /// A face is selected if all its nodes have unknowns, as other nodes have no
  /// row, and if one node has little soil. A penalty inside full cells would
  /// stiffen the soil and add entries to the matrix. The jump of the normal
  /// derivative of bilinear functions is (1, -2, 1)/h times the nodal
  /// displacements of a row, interpolated along the face by the shape functions
  /// of the face.
  template <int dim>
  void
  GhostStabilization<dim>::find_faces(const Grid<dim>     &grid,
                                      const Unknowns<dim> &unknowns,
                                      const double         gamma,
                                      const double         shear_modulus,
                                      const double         little)
  {
    faces_.clear();
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      {
        const Cell<dim> &cell = grid.cells()[c];
        if (!cell.uniform)
          continue;
        const double h = cell.size;
        // Face between the cell and the next cell along each axis.
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            constexpr unsigned int middle = power(3, dim) / 2;
            // No next cell: boundary of the mesh, or change of the cell size.
            if (cell.neighbors[middle + power(3, axis)] ==
                numbers::invalid_unsigned_int)
              continue;
            Face face;
            bool has_unknowns = true, needs_it = false;
            for (unsigned int row = 0; row < n_rows; ++row)
              // Entry 1 of a patch is the lower node of the cell, 2 the upper
              // node, which lies on the face, and 3 the upper node of the next
              // cell.
              for (unsigned int k = 0; k < 3; ++k)
                {
                  unsigned int at = (1 + k) * power(4, axis), bit = 0;
                  for (unsigned int d = 0; d < dim; ++d)
                    if (d != axis)
                      at += (1 + ((row >> bit++) & 1)) * power(4, d);
                  const unsigned int node = cell.patch[at];
                  face.nodes[3 * row + k] = node;
                  if (!unknowns.is_active(node))
                    has_unknowns = false;
                  else if (filling(grid, unknowns, node, std::pow(h, dim)) <
                           little)
                    needs_it = true;
                }
            // gamma G h, times the unit of [du/dn] squared, 1/h^2, and the
            // area.
            face.stiffness =
              gamma * shear_modulus * h / (h * h) * std::pow(h, dim - 1);
            if (has_unknowns && needs_it)
              faces_.push_back(face);
          }
      }
  }



  /// Product of the jump coefficients (1, -2, 1) of both nodes in their rows,
  /// and of the mass matrix of the face over its area: per axis 1/3 for the
  /// same row, 1/6 for neighbouring rows. The coefficients of a row sum up to
  /// zero, so rigid motions and displacements linear in space cause no force.
  template <int dim>
  double
  GhostStabilization<dim>::coupling(const unsigned int a, const unsigned int b)
  {
    const std::array<double, 3> jump = {{1., -2., 1.}};
    // Mean over the face of the product of the shape functions of two vertices.
    double mass = 1.;
    for (unsigned int bit = 0; bit + 1 < dim; ++bit)
      mass *=
        (((a / 3) >> bit) & 1) == (((b / 3) >> bit) & 1) ? 1. / 3. : 1. / 6.;
    return mass * jump[a % 3] * jump[b % 3];
  }



  /// Add K_g u component by component, as the penalty does not couple
  /// components. The caller must send the values at ghost nodes to their
  /// owners.
  template <int dim>
  void
  GhostStabilization<dim>::add_forces(const std::vector<double> &u,
                                      std::vector<double>       &forces) const
  {
    for (const Face &face : faces_)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            const double k = face.stiffness * coupling(a, b);
            for (unsigned int d = 0; d < dim; ++d)
              forces[dim * face.nodes[a] + d] += k * u[dim * face.nodes[b] + d];
          }
  }



  template <int dim>
  void
  GhostStabilization<dim>::couple(StiffnessMatrix<dim> &matrix) const
  {
    for (const Face &face : faces_)
      matrix.couple(face.nodes);
  }



  /// All components of the displacement have the same matrix.
  template <int dim>
  void
  GhostStabilization<dim>::add_to_matrix(StiffnessMatrix<dim> &matrix) const
  {
    FullMatrix<double> block(dim * n_nodes, dim * n_nodes);
    for (const Face &face : faces_)
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int b = 0; b < n_nodes; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              block(dim * a + d, dim * b + d) = face.stiffness * coupling(a, b);
        matrix.add(face.nodes, block);
      }
  }



  template class GhostStabilization<2>;
  template class GhostStabilization<3>;
} // namespace talus

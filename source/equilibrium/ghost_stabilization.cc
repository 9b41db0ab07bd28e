// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/ghost_stabilization.h>

#include <deal.II/lac/full_matrix.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// How much of a node's share of the mesh soil fills.
    /// A node inside has a share of one cell's volume, which each face of the
    /// mesh that it lies on cuts in half. In units of the share, so that a node
    /// on a full wall counts as full.
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



  /// Each face belongs to the rank that owns the cell below it, and is found
  /// with that cell. Its rows of three nodes (below, on and above the face) are
  /// in the cell's patch of 4^dim nodes, which is complete in uniform cells
  /// only: at the seam between cell sizes nothing is stabilized.
  ///
  /// A face takes part if all its nodes have unknowns, as one without has no
  /// row, and if one of them has little soil. All other faces are left alone: a
  /// penalty within full cells would stiffen the soil, and cost entries of the
  /// matrix. The jump of the normal derivative of bilinear functions is (1, -2,
  /// 1)/h times the nodal displacements of a row, interpolated along the face
  /// by its own shape functions.
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
        // The face with the next cell along each axis.
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            constexpr unsigned int middle = power(3, dim) / 2;
            // No cell beyond: a face of the mesh, or one where cells of another
            // size begin.
            if (cell.neighbors[middle + power(3, axis)] ==
                numbers::invalid_unsigned_int)
              continue;
            Face face;
            bool has_unknowns = true, needs_it = false;
            for (unsigned int row = 0; row < n_rows; ++row)
              // Entry 1 of a patch is the cell's lower node, 2 its upper one,
              // which lies on the face, and 3 that of the next cell.
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
            // gamma G h, times the squared unit of [du/dn] and the area.
            face.stiffness =
              gamma * shear_modulus * h / (h * h) * std::pow(h, dim - 1);
            if (has_unknowns && needs_it)
              faces_.push_back(face);
          }
      }
  }



  /// Product of the jump's coefficients of both nodes in their rows, (1, -2,
  /// 1), and of the face's mass matrix over its area: per axis 1/3 where the
  /// rows are the same, 1/6 where they are neighbours. The rows sum up to zero,
  /// so rigid motions and all displacements linear in space meet no force.
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



  /// K_g u, one component after the other: the penalty does not couple them. At
  /// ghost nodes it adds, too; the caller sends these to their owners.
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



  /// The penalty may reach farther than the points of either cell: without
  /// these entries the matrix would have no room for it. Held unknowns keep
  /// their entries, since constraints change within a load step.
  template <int dim>
  void
  GhostStabilization<dim>::add_to_pattern(
    const Unknowns<dim>               &unknowns,
    TrilinosWrappers::SparsityPattern &pattern) const
  {
    std::vector<types::global_dof_index> columns(n_nodes);
    for (const Face &face : faces_)
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int a = 0; a < n_nodes; ++a)
            columns[a] = unknowns.first(face.nodes[a]) + d;
          unknowns.constraints().add_entries_local_to_global(columns,
                                                             pattern,
                                                             true);
        }
  }



  /// The same matrix for each component. What is at ghost nodes travels to the
  /// owners of the rows when the caller compresses the matrix.
  template <int dim>
  void
  GhostStabilization<dim>::add_to_matrix(
    const Unknowns<dim> &unknowns, TrilinosWrappers::SparseMatrix &matrix) const
  {
    FullMatrix<double>                   face_matrix(n_nodes, n_nodes);
    std::vector<types::global_dof_index> rows(n_nodes);
    for (const Face &face : faces_)
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int b = 0; b < n_nodes; ++b)
            face_matrix(a, b) = face.stiffness * coupling(a, b);
        for (unsigned int d = 0; d < dim; ++d)
          {
            for (unsigned int a = 0; a < n_nodes; ++a)
              rows[a] = unknowns.first(face.nodes[a]) + d;
            unknowns.constraints().distribute_local_to_global(face_matrix,
                                                              rows,
                                                              matrix);
          }
      }
  }



  template class GhostStabilization<2>;
  template class GhostStabilization<3>;
} // namespace talus

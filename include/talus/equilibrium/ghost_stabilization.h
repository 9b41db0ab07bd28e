// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_ghost_stabilization_h
#define talus_equilibrium_ghost_stabilization_h

#include <talus/equilibrium/stiffness_matrix.h>

#include <vector>

namespace talus
{
  /// Ghost penalty: ties nodes that are touched by very little soil to their
  /// neighbours. The stiffness of a node vanishes with the square of the
  /// weights, and a few points may leave several nodes without stiffness, so
  /// the matrix would be singular or nearly singular.
  ///
  /// On the faces between cells at such nodes the jump of the normal derivative
  /// of the displacement is penalised by the energy
  ///   1/2 gamma G h integral over the face of |[du/dn]|^2,
  /// which is zero for displacements linear in space @cite burman2010,
  /// @cite coombs2023. The penalty acts on the displacement of a load step
  /// only; steps without further load lead to the equilibrium without penalty.
  template <int dim>
  class GhostStabilization
  {
  public:
    /// Select the faces with at least one node that has little soil.
    /// @param grid Background grid.
    /// @param unknowns Unknowns of the load step.
    /// @param gamma Factor of the penalty [-].
    /// @param shear_modulus Shear modulus G of the penalty, Pa.
    /// @param little Volume fraction of soil at a node below which the node has
    ///   little soil [-].
    void
    find_faces(const Grid<dim>     &grid,
               const Unknowns<dim> &unknowns,
               double               gamma,
               double               shear_modulus,
               double               little = 0.1);

    /// Add the penalty forces of the faces of this rank, N, at the
    /// displacements @p u, m, to @p forces, with the sign of internal forces.
    /// Ghost nodes included.
    void
    add_forces(const std::vector<double> &u, std::vector<double> &forces) const;

    /// Couple the nodes of each face in the pattern of @p matrix: the penalty
    /// may couple nodes beyond the points of either cell.
    void
    couple(StiffnessMatrix<dim> &matrix) const;

    /// Add the derivative of the penalty forces, N/m.
    void
    add_to_matrix(StiffnessMatrix<dim> &matrix) const;

    unsigned int
    n_faces() const
    {
      return faces_.size();
    }

  private:
    /// Nodes of a face in rows normal to it (below, on and above), one row for
    /// each vertex of the face.
    static constexpr unsigned int n_rows  = power(2, dim - 1);
    static constexpr unsigned int n_nodes = 3 * n_rows;
    struct Face
    {
      std::array<unsigned int, n_nodes> nodes;
      double                            stiffness; ///< N/m
    };

    /// Coupling of the nodes @p a and @p b of a face, over the stiffness of the
    /// face.
    static double
    coupling(unsigned int a, unsigned int b);

    std::vector<Face> faces_;
  };
} // namespace talus

#endif

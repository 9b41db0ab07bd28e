// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_ghost_stabilization_h
#define talus_equilibrium_ghost_stabilization_h

#include <talus/equilibrium/unknowns.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <vector>

namespace talus
{
  /// Holds nodes that hardly any soil touches to their neighbours. At such a
  /// node the stiffness vanishes with the square of the weights, and a few
  /// points may leave several nodes without any: the matrix would be singular
  /// or nearly so.
  ///
  /// On the faces between cells at such nodes the jump of the displacement's
  /// normal derivative is penalised by the energy
  ///   1/2 gamma G h integral over the face of |[du/dn]|^2:
  /// nothing for displacements that are linear in space @cite burman2010,
  /// @cite coombs2023. It acts on the displacement of a load step only; steps
  /// without further load lead to the equilibrium without it.
  template <int dim>
  class GhostStabilization
  {
  public:
    /// Find the faces: those with a node whose share of the mesh is filled with
    /// soil to less than the part @p little. The penalty is
    /// @p gamma times @p shear_modulus, Pa.
    void
    find_faces(const Grid<dim>     &grid,
               const Unknowns<dim> &unknowns,
               double               gamma,
               double               shear_modulus,
               double               little = 0.1);

    /// Add the forces of this rank's faces, N, that the displacements @p u, m,
    /// meet.
    void
    add_forces(const std::vector<double> &u, std::vector<double> &forces) const;

    void
    add_to_pattern(const Unknowns<dim>                       &unknowns,
                   dealii::TrilinosWrappers::SparsityPattern &pattern) const;

    void
    add_to_matrix(const Unknowns<dim>                    &unknowns,
                  dealii::TrilinosWrappers::SparseMatrix &matrix) const;

    unsigned int
    n_faces() const
    {
      return faces_.size();
    }

  private:
    /// Nodes in rows normal to the face: below, on, above; face vertex by
    /// face vertex.
    static constexpr unsigned int n_rows  = power(2, dim - 1);
    static constexpr unsigned int n_nodes = 3 * n_rows;
    struct Face
    {
      std::array<unsigned int, n_nodes> nodes;
      double                            stiffness; ///< N/m
    };

    /// Coupling of two nodes of a face, in units of its stiffness.
    static double
    coupling(unsigned int a, unsigned int b);

    std::vector<Face> faces_;
  };
} // namespace talus

#endif

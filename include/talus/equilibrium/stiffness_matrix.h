// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_stiffness_matrix_h
#define talus_equilibrium_stiffness_matrix_h

#include <talus/equilibrium/unknowns.h>

#include <deal.II/base/array_view.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <memory>
#include <vector>

namespace talus
{
  /// Sparse matrix of the tangent stiffness in a load step, N/m, with the rows
  /// and columns of Unknowns. All unknowns of two coupled nodes are coupled, so
  /// an element matrix is placed by one search per pair of nodes, not by one
  /// search per entry. Rows and columns of held unknowns keep their places in
  /// the pattern, as contact states change within a load step.
  template <int dim>
  class StiffnessMatrix
  {
  public:
    /// Nodes of an element matrix, without repetition: row dim * a + d belongs
    /// to component d of nodes[a].
    using Nodes = dealii::ArrayView<const unsigned int>;

    /// Start a new pattern for @p unknowns, which must outlive this object.
    void
    begin_pattern(const Unknowns<dim> &unknowns);

    /// Couple all of @p nodes with each other.
    void
    couple(const Nodes &nodes);

    /// Finish the pattern; all values are zero. Collective.
    void
    finish_pattern();

    /// Set all values to zero.
    void
    clear();

    /// Add the element matrix @p block, N/m, of coupled @p nodes.
    void
    add(const Nodes &nodes, const dealii::FullMatrix<double> &block);

    /// Send the rows of ghost nodes to their owners, hold the unknowns that are
    /// held now, and add the fraction @p shift of the diagonal to the diagonal:
    /// where soil can move freely, a solution is then large, but not infinite.
    /// A held unknown keeps only the diagonal entry. Collective.
    void
    finish(double shift);

    const dealii::TrilinosWrappers::SparseMatrix &
    matrix() const
    {
      return matrix_;
    }

  private:
    void
    add_to_own_rows(unsigned int                      node,
                    unsigned int                      a,
                    const dealii::FullMatrix<double> &block);
    void
    add_to_ghost_rows(const Nodes                      &nodes,
                      unsigned int                      a,
                      const dealii::FullMatrix<double> &block);

    const Unknowns<dim> *unknowns_ = nullptr;
    std::unique_ptr<dealii::TrilinosWrappers::SparsityPattern> pattern_;
    dealii::TrilinosWrappers::SparseMatrix                     matrix_;
    /// First column of each node in the numbering of this rank; -1 for nodes
    /// that are not active.
    std::vector<int> column_of_node_;

    // Scratch memory
    std::vector<dealii::types::global_dof_index> indices_;
    std::vector<std::pair<int, unsigned int>>    columns_;
    std::vector<bool>                            is_held_;
  };
} // namespace talus

#endif

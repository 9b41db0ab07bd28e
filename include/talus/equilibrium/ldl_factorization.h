// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_ldl_factorization_h
#define talus_equilibrium_ldl_factorization_h

#include <talus/equilibrium/elimination_fronts.h>

#include <deal.II/base/aligned_vector.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace talus
{
  /// Factorization L D L^T of a sparse symmetric matrix on one rank, by the
  /// multifrontal method @cite duff1983: the work is done in dense matrices, in
  /// full registers. There is no search for pivots, as matrices of static
  /// equilibrium are positive definite until soil fails; the caller must check
  /// the residual of a solution.
  ///
  /// The unknowns come in groups of n consecutive unknowns, the components at a
  /// node. Unknowns of two coupled nodes are all coupled.
  class LdlFactorization
  {
  public:
    /// Prepare the factorization of matrices with the pattern of @p matrix and
    /// @p n_components unknowns per node.
    void
    analyze(const Epetra_CrsMatrix &matrix, unsigned int n_components);

    /// Return whether analyze() was called since clear().
    bool
    is_analyzed() const
    {
      return !panels_.empty();
    }

    void
    clear()
    {
      panels_.clear();
    }

    /// Factorize a matrix of the pattern given to analyze(). Returns false if a
    /// pivot is zero or not a number.
    bool
    factorize(const Epetra_CrsMatrix &matrix);

    /// Replace the right-hand side @p x by the solution.
    void
    solve(double *x);

  private:
    /// Eliminated columns of a front: the entries of L D by columns. The
    /// diagonal has the entries of D.
    struct Panel
    {
      std::size_t  begin; ///< index of the first entry in factors_
      unsigned int n_rows, n_columns;
      unsigned int stride; ///< distance between columns, in entries
    };

    /// Matrix entries of two nodes: index in the row of the first node, and row
    /// in the front.
    struct Block
    {
      unsigned int offset, row;
    };

    /// Rows [begin, end) of the rest of a front, and their first row in the
    /// parent, in nodes.
    struct RowRange
    {
      unsigned int begin, end, row;
    };

    void
    make_panels();
    void
    find_blocks(const Epetra_CrsMatrix &matrix);
    void
    add_matrix(const Epetra_CrsMatrix &matrix,
               unsigned int            f,
               double                 *to) const;
    void
    add_child(unsigned int child, std::size_t stride, double *to);
    void
    keep_rest(unsigned int f, const double *front);

    EliminationFronts             fronts_;
    unsigned int                  n_components_ = 0;
    std::vector<Panel>            panels_;
    dealii::AlignedVector<double> factors_;
    std::vector<Block>            blocks_;
    std::vector<std::size_t>      first_block_; ///< of the node at each place

    // Scratch memory. The fronts that wait for their parent lie on a stack,
    // without the eliminated columns.
    dealii::AlignedVector<double> stack_;
    std::vector<std::size_t>      rest_; ///< index of each front on the stack
    std::vector<unsigned int>     row_in_front_; ///< by place
    std::vector<RowRange>         ranges_;
    dealii::AlignedVector<double> local_;
    std::vector<double>           permuted_;
  };
} // namespace talus

#endif

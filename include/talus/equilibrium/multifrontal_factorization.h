// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_multifrontal_factorization_h
#define talus_equilibrium_multifrontal_factorization_h

#include <talus/equilibrium/elimination_fronts.h>

#include <deal.II/base/aligned_vector.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <vector>

namespace talus
{
  /// Factorization L D U of a sparse matrix with symmetric pattern on one rank,
  /// with unit triangles L and U; U = L^T if the matrix is symmetric. The
  /// multifrontal method @cite duff1983 does the work in dense matrices, in full
  /// registers. There is no search for pivots, as matrices of static equilibrium
  /// are nearly symmetric and positive definite until soil fails; the caller
  /// must check the residual of a solution.
  ///
  /// The unknowns come in groups of n consecutive unknowns, the components at a
  /// node. Unknowns of two coupled nodes are all coupled.
  class MultifrontalFactorization
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

    /// Factorize a matrix of the pattern given to analyze(); half of the work is
    /// saved if @p is_symmetric. Returns false if a pivot is zero or not a
    /// number.
    bool
    factorize(const Epetra_CrsMatrix &matrix, bool is_symmetric);

    /// Replace the right-hand side @p x by the solution.
    void
    solve(double *x);

  private:
    /// Eliminated columns of a front: the entries of L D, and of U^T D, by
    /// columns. The diagonal has the entries of D.
    struct Panel
    {
      std::size_t  begin; ///< index of the first entry in Half::factors
      unsigned int n_rows, n_columns;
      unsigned int stride; ///< distance between columns, in entries
    };

    /// Lower triangle of the matrix, or transposed upper triangle.
    struct Half
    {
      dealii::AlignedVector<double> factors;
      /// Scratch memory: the fronts that wait for their parent, without the
      /// eliminated columns.
      dealii::AlignedVector<double> stack;
    };

    /// Matrix entries of two nodes: indices in the row of the first node and in
    /// the row of the second node, and row in the front.
    struct Block
    {
      unsigned int second_node, in_first, in_second, row;
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
    start_front(unsigned int f);
    void
    add_matrix(const Epetra_CrsMatrix &matrix,
               unsigned int            f,
               unsigned int            half,
               double                 *to) const;
    void
    add_child(unsigned int  child,
              std::size_t   stride,
              const double *stack,
              double       *to);
    void
    keep_rest(unsigned int f, const double *front, double *to) const;
    void
    copy_rows(unsigned int f, bool to_front);

    EliminationFronts        fronts_;
    unsigned int             n_components_ = 0;
    bool                     is_symmetric_ = true;
    std::vector<Panel>       panels_;
    std::array<Half, 2>      halves_; ///< the second is empty if symmetric
    std::vector<Block>       blocks_;
    std::vector<std::size_t> first_block_; ///< first block of each place
    std::vector<std::size_t> rest_;        ///< index on the stack, by front
    std::size_t              stack_size_ = 0, n_factors_ = 0;

    // Scratch memory
    std::vector<unsigned int>     row_in_front_; ///< by place
    std::vector<RowRange>         ranges_;
    dealii::AlignedVector<double> local_;
    std::vector<double>           permuted_;
  };
} // namespace talus

#endif

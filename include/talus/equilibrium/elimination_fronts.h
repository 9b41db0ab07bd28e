// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_elimination_fronts_h
#define talus_equilibrium_elimination_fronts_h

#include <vector>

namespace talus
{
  /// Symmetric pattern of a matrix: the neighbours of unknown k are
  /// neighbours[first[k]] to neighbours[first[k + 1] - 1]; k itself may be among
  /// them.
  struct SymmetricPattern
  {
    std::vector<int> first, neighbours;

    unsigned int
    n_unknowns() const
    {
      return first.size() - 1;
    }
  };



  /// Order in which a symmetric matrix is factorized with little fill-in, and
  /// the dense submatrices, the fronts, of the multifrontal method
  /// @cite duff1983. Depends on the pattern of the matrix only. The order is
  /// that of minimum degree @cite amestoy2004.
  class EliminationFronts
  {
  public:
    /// Dense submatrix from which consecutive unknowns are eliminated.
    struct Front
    {
      unsigned int first;     ///< place of the first eliminated unknown
      unsigned int n_columns; ///< number of eliminated unknowns
      /// Places of all rows, ascending; the first n_columns are eliminated.
      std::vector<unsigned int> rows;
      /// Fronts whose remaining rows are added to this front.
      std::vector<unsigned int> children;
    };

    EliminationFronts() = default;
    explicit EliminationFronts(const SymmetricPattern &pattern);

    /// Fronts in the order of elimination: children before their parent.
    const std::vector<Front> &
    fronts() const
    {
      return fronts_;
    }

    /// Index of the unknown at each place of the order of elimination.
    const std::vector<unsigned int> &
    order() const
    {
      return order_;
    }

    /// Place of each unknown in the order of elimination.
    const std::vector<unsigned int> &
    place() const
    {
      return place_;
    }

  private:
    void
    set_order(std::vector<unsigned int> order);
    std::vector<unsigned int>
    parents(const SymmetricPattern &pattern) const;
    void
    find_fronts(const SymmetricPattern          &pattern,
                const std::vector<unsigned int> &parent);
    void
    merge_fronts();
    void
    find_children();

    std::vector<Front>        fronts_;
    std::vector<unsigned int> order_, place_;
  };
} // namespace talus

#endif

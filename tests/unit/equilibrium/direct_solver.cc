// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/direct_solver.h>

#include <deal.II/base/index_set.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace
{
  using namespace talus;
  using SystemMatrix = dealii::TrilinosWrappers::SparseMatrix;
  using Vector       = dealii::TrilinosWrappers::MPI::Vector;

  /// Unknowns coupled with their neighbours in a rectangle of n_x times n_y.
  SymmetricPattern
  rectangle(const int n_x, const int n_y)
  {
    SymmetricPattern pattern;
    pattern.first.push_back(0);
    for (int y = 0; y < n_y; ++y)
      for (int x = 0; x < n_x; ++x)
        {
          for (int j = std::max(y - 1, 0); j <= std::min(y + 1, n_y - 1); ++j)
            for (int i = std::max(x - 1, 0); i <= std::min(x + 1, n_x - 1); ++i)
              pattern.neighbours.push_back(n_x * j + i);
          pattern.first.push_back(pattern.neighbours.size());
        }
    return pattern;
  }



  /// Number of entries on and below the diagonal in the columns of all fronts.
  double
  n_entries_of_factors(const EliminationFronts &fronts)
  {
    double n = 0;
    for (const auto &front : fronts.fronts())
      for (unsigned int k = 0; k < front.n_columns; ++k)
        n += front.rows.size() - k;
    return n;
  }



  /// Two unknowns at each place of a rectangle.
  struct System
  {
    System(const int n_x, const int n_y)
      : pattern(rectangle(n_x, n_y))
      , owned(dealii::complete_index_set(2 * n_x * n_y))
      , rhs(owned, MPI_COMM_SELF)
      , x(rhs)
    {
      dealii::TrilinosWrappers::SparsityPattern all(owned, MPI_COMM_SELF);
      for_each_entry(
        [&](const unsigned int i, const unsigned int j) { all.add(i, j); });
      all.compress();
      matrix.reinit(all);
      for (unsigned int i = 0; i < rhs.size(); ++i)
        rhs(i) = std::sin(1. + i);
    }

    template <typename Action>
    void
    for_each_entry(const Action &action) const
    {
      for (unsigned int k = 0; k < pattern.n_unknowns(); ++k)
        for (int a = pattern.first[k]; a < pattern.first[k + 1]; ++a)
          for (unsigned int d = 0; d < 2; ++d)
            for (unsigned int e = 0; e < 2; ++e)
              action(2 * k + d, 2 * pattern.neighbours[a] + e);
    }

    /// Set the diagonal entries; the others are between -1 and 1.
    void
    set(const double diagonal, const bool is_symmetric = true)
    {
      for_each_entry([&](const unsigned int i, const unsigned int j) {
        matrix.set(i,
                   j,
                   i == j ? diagonal
                          : std::cos(1. * i * j + i + j +
                                     (is_symmetric ? 0. : 0.3 * i)));
      });
      matrix.compress(dealii::VectorOperation::insert);
    }

    /// Largest residual of the solution over the right-hand side.
    double
    residual(MultifrontalFactorization &factorization)
    {
      x = rhs;
      factorization.solve(x.begin());
      Vector residual(rhs);
      return matrix.residual(residual, x, rhs) / rhs.l2_norm();
    }

    SymmetricPattern pattern;
    dealii::IndexSet owned;
    SystemMatrix     matrix;
    Vector           rhs, x;
  };
} // namespace



// Every entry of the matrix must have a place in a front, and the rest of a
// front in its parent.
TEST(EliminationFronts, HoldTheMatrixAndTheRests)
{
  const SymmetricPattern  pattern = rectangle(23, 9);
  const EliminationFronts fronts(pattern);
  std::vector<bool>       seen(pattern.n_unknowns());
  unsigned int            next = 0;
  for (const auto &front : fronts.fronts())
    {
      ASSERT_EQ(front.first, next);
      const auto contains = [&](const unsigned int place) {
        return std::binary_search(front.rows.begin(), front.rows.end(), place);
      };
      for (; next < front.first + front.n_columns; ++next)
        {
          const unsigned int k = fronts.order()[next];
          EXPECT_FALSE(seen[k]);
          seen[k] = true;
          EXPECT_EQ(fronts.place()[k], next);
          for (int a = pattern.first[k]; a < pattern.first[k + 1]; ++a)
            {
              const unsigned int place = fronts.place()[pattern.neighbours[a]];
              EXPECT_TRUE(place < next || contains(place));
            }
        }
      for (const unsigned int child : front.children)
        for (const unsigned int row : fronts.fronts()[child].rows)
          EXPECT_TRUE(row < front.first || contains(row));
    }
  EXPECT_EQ(next, pattern.n_unknowns());
}



// In the natural order the columns of a rectangle of n times n have some n
// entries each; minimum degree is better the larger n is.
TEST(EliminationFronts, HaveLittleFillIn)
{
  EXPECT_LT(n_entries_of_factors(EliminationFronts(rectangle(100, 100))),
            0.5 * 100 * 1e4);
  // A strip of three rows has four neighbours ahead at most.
  EXPECT_LT(n_entries_of_factors(EliminationFronts(rectangle(300, 3))),
            8. * 900);
}



TEST(MultifrontalFactorization, SolvesDefiniteAndIndefiniteSystems)
{
  for (const auto &[n_x, n_y] : {std::pair(1, 1), {5, 1}, {40, 7}, {33, 31}})
    {
      System                    system(n_x, n_y);
      MultifrontalFactorization factorization;
      factorization.analyze(system.matrix.trilinos_matrix(), 2);
      for (const double diagonal : {20., -20., 40.})
        for (const bool is_symmetric : {true, false})
          {
            system.set(diagonal, is_symmetric);
            ASSERT_TRUE(factorization.factorize(system.matrix.trilinos_matrix(),
                                                is_symmetric));
            EXPECT_LT(system.residual(factorization), 1e-14);
          }
    }
}



TEST(MultifrontalFactorization, ReportsPivotsOfZero)
{
  System                    system(1, 1);
  MultifrontalFactorization factorization;
  factorization.analyze(system.matrix.trilinos_matrix(), 2);
  system.set(0.);
  EXPECT_FALSE(factorization.factorize(system.matrix.trilinos_matrix(), true));
  system.set(std::nan(""));
  EXPECT_FALSE(factorization.factorize(system.matrix.trilinos_matrix(), true));
}



// Without a search for pivots the diagonal of 1e-14 is a poor pivot.
TEST(DirectSolver, FallsBackToPivots)
{
  for (const double diagonal : {20., 1e-14, 0.})
    for (const bool is_symmetric : {true, false})
      {
        System       system(12, 5);
        DirectSolver solver;
        system.set(diagonal, is_symmetric);
        ASSERT_TRUE(
          solver.solve(system.matrix, 2, is_symmetric, system.x, system.rhs));
        Vector residual(system.rhs);
        EXPECT_LT(system.matrix.residual(residual, system.x, system.rhs),
                  1e-9 * system.rhs.l2_norm());
      }
}

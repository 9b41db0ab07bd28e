// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/stiffness_matrix.h>

#include <talus/base/assertion.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  /// Trilinos' own pattern is used: deal.II's function that makes a matrix from
  /// a DynamicSparsityPattern is not inline, and clang names the function
  /// differently from GCC, which compiled deal.II.
  template <int dim>
  void
  StiffnessMatrix<dim>::begin_pattern(const Unknowns<dim> &unknowns)
  {
    unknowns_ = &unknowns;
    pattern_  = std::make_unique<TrilinosWrappers::SparsityPattern>(
      unknowns.owned(),
      unknowns.owned(),
      unknowns.relevant(),
      unknowns.communicator());
  }



  template <int dim>
  void
  StiffnessMatrix<dim>::couple(const Nodes &nodes)
  {
    indices_.clear();
    for (const unsigned int node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        indices_.push_back(unknowns_->first(node) + d);
    for (const auto row : indices_)
      pattern_->add_entries(row, indices_.begin(), indices_.end());
  }



  /// compress() sends the rows of ghost nodes to their owners. Trilinos numbers
  /// the columns of each rank anew, the owned columns first, and sorts the
  /// entries of a row by these numbers.
  template <int dim>
  void
  StiffnessMatrix<dim>::finish_pattern()
  {
    pattern_->compress();
    matrix_.reinit(*pattern_);
    pattern_.reset();
    const Epetra_Map &columns = matrix_.trilinos_matrix().ColMap();
    column_of_node_.assign(unknowns_->field().size(), -1);
    for (unsigned int k = 0; k < column_of_node_.size(); ++k)
      if (unknowns_->is_active(k / dim))
        column_of_node_[k] =
          columns.LID(static_cast<int>(unknowns_->first(k / dim) + k % dim));
  }



  template <int dim>
  void
  StiffnessMatrix<dim>::clear()
  {
    matrix_ = 0.;
  }



  /// The nodes are sorted by their columns once, so that the places in a row
  /// are found in one pass over the row.
  template <int dim>
  void
  StiffnessMatrix<dim>::add(const Nodes &nodes, const FullMatrix<double> &block)
  {
    columns_.clear();
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        columns_.emplace_back(column_of_node_[dim * nodes[a] + d], dim * a + d);
    std::sort(columns_.begin(), columns_.end());
    for (unsigned int a = 0; a < nodes.size(); ++a)
      if (unknowns_->owned().is_element(unknowns_->first(nodes[a])))
        add_to_own_rows(nodes[a], a, block);
      else
        add_to_ghost_rows(nodes, a, block);
  }



  /// The dim rows of a node have the same columns, and the dim columns of a
  /// node are adjacent.
  template <int dim>
  void
  StiffnessMatrix<dim>::add_to_own_rows(const unsigned int        node,
                                        const unsigned int        a,
                                        const FullMatrix<double> &block)
  {
    // Owned columns come first and in the order of the rows.
    const int row = column_of_node_[dim * node];
    int       n_entries, *entries;
    double   *values[dim];
    for (unsigned int d = 0; d < dim; ++d)
      matrix_.trilinos_matrix().ExtractMyRowView(row + d,
                                                 n_entries,
                                                 values[d],
                                                 entries);
    // Entries are sorted on one rank; columns of ghosts may come in any order.
    int        place      = 0;
    const auto advance_to = [&](const int column) {
      for (int n = 0; n < n_entries && entries[place] != column; ++n)
        place = (place + 1 < n_entries ? place + 1 : 0);
      TalusAssert(entries[place] == column, ExcInternalError());
    };
    for (const auto &[column, j] : columns_)
      {
        advance_to(column);
        for (unsigned int d = 0; d < dim; ++d)
          values[d][place] += block(dim * a + d, j);
      }
  }



  template <int dim>
  void
  StiffnessMatrix<dim>::add_to_ghost_rows(const Nodes              &nodes,
                                          const unsigned int        a,
                                          const FullMatrix<double> &block)
  {
    indices_.clear();
    for (const unsigned int node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        indices_.push_back(unknowns_->first(node) + d);
    for (unsigned int d = 0; d < dim; ++d)
      matrix_.add(indices_[dim * a + d],
                  indices_.size(),
                  indices_.data(),
                  &block(dim * a + d, 0));
  }



  /// An unknown without stiffness has a diagonal entry of zero; if the unknown
  /// is held, any other value will do.
  template <int dim>
  void
  StiffnessMatrix<dim>::finish(const double shift)
  {
    matrix_.compress(VectorOperation::add);
    const Epetra_CrsMatrix &matrix = matrix_.trilinos_matrix();
    is_held_.assign(matrix.NumMyCols(), false);
    for (unsigned int k = 0; k < column_of_node_.size(); ++k)
      if (column_of_node_[k] >= 0)
        is_held_[column_of_node_[k]] =
          unknowns_->is_constrained(k / dim, k % dim);
    for (int row = 0; row < matrix.NumMyRows(); ++row)
      {
        int     n_entries, *columns;
        double *values;
        matrix.ExtractMyRowView(row, n_entries, values, columns);
        for (int k = 0; k < n_entries; ++k)
          if (columns[k] == row)
            values[k] = (!is_held_[row]    ? (1. + shift) * values[k]
                         : values[k] != 0. ? std::abs(values[k])
                                           : 1.);
          else if (is_held_[row] || is_held_[columns[k]])
            values[k] = 0.;
      }
  }



  template class StiffnessMatrix<2>;
  template class StiffnessMatrix<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/equilibrium/elimination_fronts.h>

#include <deal.II/base/exceptions.h>

#include <amd.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int no_parent = -1;

    /// Number of entries of the factors in a front.
    double
    n_entries(const EliminationFronts::Front &front)
    {
      return front.n_columns *
             (front.rows.size() - 0.5 * (front.n_columns - 1));
    }



    /// Order the nodes of a forest so that all descendants of a node come
    /// directly before the node. @p parent is larger than the node, or
    /// no_parent.
    std::vector<unsigned int>
    postorder(const std::vector<unsigned int> &parent)
    {
      const unsigned int        n = parent.size();
      std::vector<unsigned int> size(n, 1), end_of_children(n), order(n);
      for (unsigned int k = 0; k < n; ++k)
        if (parent[k] != no_parent)
          size[parent[k]] += size[k];
      unsigned int free = n; // places not yet taken, for roots
      for (unsigned int k = n; k-- > 0;)
        {
          unsigned int &end =
            (parent[k] == no_parent ? free : end_of_children[parent[k]]);
          order[end - 1]     = k;
          end_of_children[k] = end - 1;
          end -= size[k];
        }
      return order;
    }
  } // namespace



  EliminationFronts::EliminationFronts(const SymmetricPattern &pattern)
  {
    const int                  n = pattern.n_unknowns();
    std::vector<int>           permutation(n);
    [[maybe_unused]] const int status = amd_order(n,
                                                  pattern.first.data(),
                                                  pattern.neighbours.data(),
                                                  permutation.data(),
                                                  nullptr,
                                                  nullptr);
    Assert(status == AMD_OK || status == AMD_OK_BUT_JUMBLED,
           ExcInternalError());
    set_order({permutation.begin(), permutation.end()});
    // Eliminate the unknowns of a branch of the tree one after the other.
    std::vector<unsigned int> order = postorder(parents(pattern));
    for (unsigned int &k : order)
      k = order_[k];
    set_order(std::move(order));
    find_fronts(pattern, parents(pattern));
    merge_fronts();
    find_children();
  }



  void
  EliminationFronts::set_order(std::vector<unsigned int> order)
  {
    order_ = std::move(order);
    place_.resize(order_.size());
    for (unsigned int k = 0; k < order_.size(); ++k)
      place_[order_[k]] = k;
  }



  /// Compute the elimination tree: the parent of column k of the factor is the
  /// first row below k in the column @cite liu1990. All by place.
  std::vector<unsigned int>
  EliminationFronts::parents(const SymmetricPattern &pattern) const
  {
    const unsigned int        n = order_.size();
    std::vector<unsigned int> parent(n, no_parent), ancestor(n, no_parent);
    for (unsigned int k = 0; k < n; ++k)
      for (int i = pattern.first[order_[k]]; i < pattern.first[order_[k] + 1];
           ++i)
        // Climb from the neighbour to the root, and make k the new root.
        for (unsigned int j = place_[pattern.neighbours[i]]; j < k;)
          {
            const unsigned int next = std::exchange(ancestor[j], k);
            if (next == no_parent)
              parent[j] = k;
            j = next; // no_parent is larger than k
          }
    return parent;
  }



  /// A column of the factor has rows where the matrix, or a column whose parent
  /// it is, has rows. Successive columns with the same rows make a front.
  void
  EliminationFronts::find_fronts(const SymmetricPattern          &pattern,
                                 const std::vector<unsigned int> &parent)
  {
    const unsigned int                     n = order_.size();
    std::vector<std::vector<unsigned int>> rows(n), children(n);
    std::vector<unsigned int>              seen_by(n, no_parent);
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto add = [&](const unsigned int row) {
          if (row >= k && seen_by[row] != k)
            {
              seen_by[row] = k;
              rows[k].push_back(row);
            }
        };
        add(k);
        for (int i = pattern.first[order_[k]]; i < pattern.first[order_[k] + 1];
             ++i)
          add(place_[pattern.neighbours[i]]);
        for (const unsigned int child : children[k])
          {
            std::for_each(rows[child].begin(), rows[child].end(), add);
            rows[child] = {};
          }
        std::sort(rows[k].begin(), rows[k].end());
        if (parent[k] != no_parent)
          children[parent[k]].push_back(k);
        const bool continues = k > 0 && parent[k - 1] == k &&
                               fronts_.back().rows.size() ==
                                 rows[k].size() + fronts_.back().n_columns;
        if (continues)
          ++fronts_.back().n_columns;
        else
          fronts_.push_back({k, 1, rows[k], {}});
      }
  }



  /// Merge fronts with their parent where that adds few zeros to the factors:
  /// wide fronts are faster. Only the last child precedes its parent directly.
  void
  EliminationFronts::merge_fronts()
  {
    std::vector<Front>  merged;
    std::vector<double> n_zeros;
    for (Front &front : fronts_)
      {
        double zeros = 0;
        while (!merged.empty())
          {
            const Front &last = merged.back();
            if (last.rows.size() == last.n_columns ||
                last.rows[last.n_columns] >= front.first + front.n_columns)
              break;
            Front both{last.first, last.n_columns + front.n_columns, {}, {}};
            both.rows.resize(last.n_columns);
            std::iota(both.rows.begin(), both.rows.end(), last.first);
            both.rows.insert(both.rows.end(),
                             front.rows.begin(),
                             front.rows.end());
            const double zeros_of_both = zeros + n_zeros.back() +
                                         n_entries(both) - n_entries(last) -
                                         n_entries(front);
            // Admit all zeros in two columns, a tenth in twenty columns.
            if (zeros_of_both * both.n_columns > 2. * n_entries(both))
              break;
            zeros = zeros_of_both;
            front = std::move(both);
            merged.pop_back();
            n_zeros.pop_back();
          }
        merged.push_back(std::move(front));
        n_zeros.push_back(zeros);
      }
    fronts_ = std::move(merged);
  }



  void
  EliminationFronts::find_children()
  {
    std::vector<unsigned int> front_of_place;
    for (unsigned int f = 0; f < fronts_.size(); ++f)
      front_of_place.insert(front_of_place.end(), fronts_[f].n_columns, f);
    for (unsigned int f = 0; f < fronts_.size(); ++f)
      if (fronts_[f].rows.size() > fronts_[f].n_columns)
        fronts_[front_of_place[fronts_[f].rows[fronts_[f].n_columns]]]
          .children.push_back(f);
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/expression_surface.h>

#include <boost/functional/hash.hpp>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the result in @p table for @p key; compute the result if it is
    /// not in the table. Memory stays small where points move and ask for ever
    /// new places, and no memory is allocated in a step.
    /// The table fits into the second-level cache.
    template <typename Table, typename Key, typename Compute>
    auto
    look_up(Table &table, const Key &key, const Compute &compute)
    {
      constexpr unsigned int n = 1u << 13;
      table.resize(n);
      auto &known = table[boost::hash<Key>()(key) % n];
      if (known.key != key)
        known = {key, compute()};
      return known.result;
    }
  } // namespace



  template <int dim>
  ExpressionSurface<dim>::ExpressionSurface(const std::string &path,
                                            const std::string &expression,
                                            const Constants   &constants,
                                            const std::vector<Named> &known)
    : expression_(path,
                  expression,
                  constants,
                  known,
                  PlaceExpression<dim>::Variables::plan)
  {}



  template <int dim>
  double
  ExpressionSurface<dim>::height(const Point<dim> &x) const
  {
    return expression_.at(x);
  }



  /// The corners of the cells of a column, and the places where cells are cut,
  /// have few distinct places in plan, which are evaluated repeatedly; a table
  /// keeps recent results. A collision of the hash overwrites the older result.
  template <int dim>
  typename ExpressionSurface<dim>::Value
  ExpressionSurface<dim>::at(const Point<dim> &x) const
  {
    const std::array<double, 2> key = {{x[0], dim == 3 ? x[dim - 1] : 0.}};
    return look_up(values_, key, [&] { return compute_value(x); });
  }



  /// Only the expression itself is differentiated by differences: the named
  /// surfaces have their own slopes, also at the edge of a raster.
  template <int dim>
  typename ExpressionSurface<dim>::Value
  ExpressionSurface<dim>::compute_value(const Point<dim> &x) const
  {
    typename PlaceExpression<dim>::Arguments                  arguments;
    boost::container::small_vector<dealii::Tensor<1, dim>, 8> slopes;
    for (unsigned int d = 0; d < dim; d += 2)
      {
        arguments.push_back(x[d]);
        slopes.emplace_back()[d] = 1.;
      }
    for (const Named &other : expression_.surfaces())
      {
        const Value value = other.second->at(x);
        arguments.push_back(value.height);
        slopes.push_back(value.slope);
      }
    // Small enough to resolve slopes of millimetre features of flumes to 1e-4,
    // and large enough to resolve slopes of heights of kilometres to 1e-7. Only
    // two evaluations, because contact evaluates surfaces in each step.
    constexpr double step = 1e-5;
    Value            result{expression_.evaluate(arguments), {}};
    for (unsigned int i = 0; i < arguments.size(); ++i)
      {
        auto after = arguments, before = arguments;
        after[i] += step;
        before[i] -= step;
        result.slope +=
          (expression_.evaluate(after) - expression_.evaluate(before)) /
          (after[i] - before[i]) * slopes[i];
      }
    return result;
  }



  template <int dim>
  bool
  ExpressionSurface<dim>::is_known_at(const Point<dim> &x) const
  {
    return std::all_of(expression_.surfaces().begin(),
                       expression_.surfaces().end(),
                       [&x](const Named &other) {
                         return other.second->is_known_at(x);
                       });
  }



  /// Boxes above each other have the same centre in plan, and the change takes
  /// eight heights: a table keeps recent results, too.
  template <int dim>
  double
  ExpressionSurface<dim>::largest_change(const Point<dim> &x,
                                         const double      distance) const
  {
    const std::array<double, 3> key = {
      {x[0], dim == 3 ? x[dim - 1] : 0., distance}};
    return look_up(changes_, key, [&] {
      return compute_largest_change(x, distance);
    });
  }



  template <int dim>
  double
  ExpressionSurface<dim>::compute_largest_change(const Point<dim> &x,
                                                 const double distance) const
  {
    const Value here   = at(x);
    double      change = distance * here.slope.norm();
    for (unsigned int d = 0; d < dim; d += 2)
      for (const double share : {-1., -0.5, 0.5, 1.})
        {
          Point<dim> beside = x;
          beside[d] += share * distance;
          if (is_known_at(beside))
            change = std::max(change, std::abs(height(beside) - here.height));
        }
    return 1.5 * change;
  }



  template class ExpressionSurface<2>;
  template class ExpressionSurface<3>;
} // namespace talus

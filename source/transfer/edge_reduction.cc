// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points_kernel.h>
#include <talus/transfer/edge_reduction.h>

#include <array>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // An edge is shortened along v if its component along v exceeds this
    // multiple of |v|. Above a half, so that the next change needs a further
    // fifth of a unit of shear: round-off never changes a basis to and fro.
    constexpr double max_overlap = 0.6;

    // Growth of an edge since the creation of the point beyond which the edge
    // may be shortened. Flat points of a clipped surface keep their shape.
    constexpr double min_growth = 1.15;

    // An edge is shortened along other edges only if each has at least this
    // fraction of its length. In 3-D a larger fraction would keep many cells of
    // general shear long, and split them.
    template <int dim>
    constexpr double min_ratio = (dim == 2 ? 0.5 : 0.3);

    // A film of soil one point thick has neighbours along the film and none
    // across: a long edge along the film stands for soil that must be split. In
    // 3-D an edge is shortened by a vector that goes through this part of the
    // film or less, so that three of four points have the neighbour. In 2-D a
    // stretched sheet would tear (tests/cases/thin-slide.prm), and an edge is
    // shortened along a longer edge only.
    constexpr double largest_share = 0.25;

    // Growth beyond which the edge is shortened along edges of any length. The
    // splitter has a limit and could not halve the edge.
    constexpr double max_growth = 4.6;

    // Growth at which shear that is counted must end.
    constexpr double max_counted_growth = 1000.;

    /// Integer combination v = sum_j shift[j] a_j of the edges other than k.
    template <int dim>
    using Shift = std::array<int, dim>;



    /// Call action(k, shift) for each edge k and each combination of the other
    /// edges along which edge k may be shortened.
    template <int dim, typename Action>
    TALUS_ALWAYS_INLINE void
    for_each_shift(const Action &action)
    {
      for (unsigned int k = 0; k < dim; ++k)
        {
          const unsigned int i = (k + 1) % dim, j = (k + 2) % dim;
          Shift<dim>         shift{};
          shift[i] = 1;
          action(k, shift);
          if constexpr (dim == 3)
            {
              for (const int of_j : {1, -1})
                {
                  shift[j] = of_j;
                  action(k, shift);
                }
              shift[i] = 0;
              action(k, shift);
            }
        }
    }



    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE Number
    product(const std::array<Number, dim> &a, const std::array<Number, dim> &b)
    {
      Number sum = a[0] * b[0];
      for (unsigned int i = 1; i < dim; ++i)
        sum += a[i] * b[i];
      return sum;
    }



    /// Edges of the cell of point(s) p, with the limits of their lengths.
    template <int dim, typename Number>
    struct Edges
    {
      std::array<std::array<Number, dim>, dim> edge; ///< m
      /// Squares of lengths: of the edges, of edges that may be shortened, and
      /// of edges that must be shortened, m^2.
      std::array<Number, dim> square, may_shorten, must_shorten;
      /// Film in which the point lies.
      std::optional<Film<dim>> film;

      TALUS_ALWAYS_INLINE
      Edges(const PointsView<dim> &points,
            const unsigned int     p,
            const bool             counts_shear)
      {
        for (unsigned int k = 0; k < dim; ++k)
          {
            for (unsigned int i = 0; i < dim; ++i)
              edge[k][i] =
                load<Number>(points.data(points.edges, dim * i + k) + p);
            square[k] = product<dim, Number>(edge[k], edge[k]);
            const auto at_creation =
              load<Number>(points.data(points.length_at_creation, k) + p);
            const Number lower =
              (counts_shear ? max_counted_growth : min_growth) * at_creation;
            const Number upper =
              (counts_shear ? max_counted_growth : max_growth) * at_creation;
            may_shorten[k]  = lower * lower;
            must_shorten[k] = upper * upper;
          }
      }

      /// Return the vector v of @p shift, m.
      TALUS_ALWAYS_INLINE std::array<Number, dim>
                          combination(const Shift<dim> &shift) const
      {
        std::array<Number, dim> v{};
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int i = 0; shift[j] != 0 && i < dim; ++i)
            v[i] = (shift[j] > 0 ? v[i] + edge[j][i] : v[i] - edge[j][i]);
        return v;
      }

      /// Return a mask: whether edge @p k must be shortened along @p shift.
      TALUS_ALWAYS_INLINE auto
      is_long(const unsigned int k, const Shift<dim> &shift) const
      {
        const auto   v        = combination(shift);
        const Number along    = product<dim, Number>(edge[k], v);
        const Number limit    = max_overlap * product<dim, Number>(v, v);
        Number       shortest = square[k];
        for (unsigned int j = 0; j < dim; ++j)
          if (shift[j] != 0)
            shortest = min(shortest, square[j]);
        return (along * along > limit * limit) & (square[k] > may_shorten[k]) &
               ((shortest > min_ratio<dim> * min_ratio<dim> * square[k]) |
                (square[k] > must_shorten[k]));
      }

      /// Multiple of the vector of @p shift by which edge @p k is shortened.
      Number
      multiple(const unsigned int k, const Shift<dim> &shift) const
      {
        const auto v = combination(shift);
        return std::round(product<dim, Number>(edge[k], v) /
                          product<dim, Number>(v, v));
      }

      /// Whether edge @p k may be shortened along @p shift in a film.
      bool
      stays_in_film(const unsigned int k, const Shift<dim> &shift) const
      {
        if (!film || square[k] > must_shorten[k])
          return true;
        if (dim == 2)
          return square[1 - k] > square[k];
        const auto v      = combination(shift);
        Number     across = 0.;
        for (unsigned int i = 0; i < dim; ++i)
          across += film->normal[i] * v[i];
        return std::abs(multiple(k, shift) * across) <=
               largest_share * film->thickness;
      }

      /// Shorten edge @p k along @p shift as far as possible.
      void
      shorten(const unsigned int k, const Shift<dim> &shift)
      {
        const auto   v = combination(shift);
        const Number m = multiple(k, shift);
        for (unsigned int i = 0; i < dim; ++i)
          edge[k][i] -= m * v[i];
        square[k] = product<dim, Number>(edge[k], edge[k]);
      }
    };



    /// Return whether an edge of the points in the register at @p p is long.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE bool
    any_is_long(const PointsView<dim> &points,
                const unsigned int     p,
                const bool             counts_shear)
    {
      const Edges<dim, Number> edges(points, p, counts_shear);
      auto                     found = Number(1.) < Number(0.);
      for_each_shift<dim>(
        [&](const unsigned int k, const auto &shift)
          TALUS_INLINE_LAMBDA { found |= edges.is_long(k, shift); });
      return any(found);
    }



    /// Shorten one edge and return its index, or dim if no edge is long.
    ///
    /// If several edges are long, shorten the edge with the largest growth
    /// since the creation of the point. Shear has made this edge; an edge with
    /// less growth connects the point with its neighbours. A film tears if the
    /// wrong edge is shortened. Growths that differ by round-off are equal.
    template <int dim>
    unsigned int
    shorten_one(Edges<dim, double> &edges)
    {
      unsigned int shortened = dim;
      double       growth    = 0;
      Shift<dim>   along;
      for_each_shift<dim>([&](const unsigned int k, const auto &shift) {
        const double of_k = edges.square[k] / edges.must_shorten[k];
        if (!edges.is_long(k, shift) || !edges.stays_in_film(k, shift) ||
            of_k <= (1. + 1e-9) * growth)
          return;
        shortened = k;
        growth    = of_k;
        along     = shift;
      });
      if (shortened != dim)
        edges.shorten(shortened, along);
      return shortened;
    }



    // Each change shortens an edge of a lattice, which has finitely many edges
    // below a length, so the loop ends.
    template <int dim>
    void
    reduce(const PointsView<dim> &points,
           const unsigned int     p,
           Edges<dim, double>    &edges)
    {
      for (unsigned int k; (k = shorten_one(edges)) != dim;)
        for (unsigned int i = 0; i < dim; ++i)
          points.data(points.edges, dim * i + k)[p] = edges.edge[k][i];
    }
  } // namespace



  // A point is reduced once per unit of shear strain. Most calls only test the
  // edges of several points at a time, in a fast pass over data in the cache.
  template <int dim>
  void
  reduce_edges(
    Points<dim>                                                 &points,
    const unsigned int                                           begin,
    const unsigned int                                           end,
    const bool                                                   counts_shear,
    const std::function<std::optional<Film<dim>>(unsigned int)> &film_at)
  {
    const auto columns = points.view();
    bool       found   = false;
    for_each_simd(
      begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        found |= any_is_long<dim, decltype(number)>(columns, p, counts_shear);
      });
    if (!found)
      return;
    for (unsigned int p = begin; p < end; ++p)
      if (any_is_long<dim, double>(columns, p, counts_shear))
        {
          Edges<dim, double> edges(columns, p, counts_shear);
          if (film_at)
            edges.film = film_at(p);
          reduce(columns, p, edges);
        }
  }



  template decltype(reduce_edges<2>) reduce_edges<2>;
  template decltype(reduce_edges<3>) reduce_edges<3>;
} // namespace talus

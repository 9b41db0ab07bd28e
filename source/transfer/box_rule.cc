// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/box_rule.h>
#include <talus/transfer/convected_domain.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Stretches l_d/L_d of the box with the second moments, along the axes, of
    /// the cell of edges A = F diag(L): l_d is the length of row d of A.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        lengths_of_rows(const Matrix<dim, Number>     &F,
                                        const std::array<Number, dim> &L)
    {
      std::array<Number, dim> stretch;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Number square(0.);
          for (unsigned int k = 0; k < dim; ++k)
            square += (F[d][k] * L[k]) * (F[d][k] * L[k]);
          stretch[d] = sqrt(square) / L[d];
        }
      return stretch;
    }



    /// Diagonal of V of F = V R in 2-D: V = (B + J I)/sqrt(tr B + 2 J) with
    /// B = F F^T, @cite hoger1984. No eigenvectors, hence no special case for
    /// equal eigenvalues.
    template <typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, 2>
                        left_stretch(const Matrix<2, Number> &F)
    {
      const Number J     = determinant(F);
      const Number B_00  = F[0][0] * F[0][0] + F[0][1] * F[0][1];
      const Number B_11  = F[1][0] * F[1][0] + F[1][1] * F[1][1];
      const Number scale = 1. / sqrt(B_00 + B_11 + 2. * J);
      return {{(B_00 + J) * scale, (B_11 + J) * scale}};
    }



    /// Set the stretch of the points [begin, end) to stretch_of(F, L).
    template <int dim, typename StretchOf>
    TALUS_ALWAYS_INLINE void
    set_stretch(const PointsView<dim> &points,
                const unsigned int     begin,
                const unsigned int     end,
                const StretchOf       &stretch_of)
    {
      for_each_simd(
        begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
          using Number = decltype(number);
          std::array<Number, dim> L;
          for (unsigned int d = 0; d < dim; ++d)
            L[d] = load<Number>(points.data(points.reference_length, d) + p);
          const auto stretch = stretch_of(
            load_matrix<dim, Number>(points, points.deformation_gradient, p),
            L);
          for (unsigned int d = 0; d < dim; ++d)
            store(points.data(points.stretch, d) + p, stretch[d]);
        });
    }
  } // namespace



  // The paper, whose boxes follow V, is about plane strain.
  template <int dim>
  void
  update_stretch(Points<dim>       &points,
                 const unsigned int begin,
                 const unsigned int end,
                 const BoxRule      rule)
  {
    if (rule == BoxRule::fixed || rule == BoxRule::convected_domain)
      return;
    if constexpr (dim == 2)
      if (rule == BoxRule::left_stretch)
        {
          set_stretch<dim>(points.view(),
                           begin,
                           end,
                           [](const auto &F, const auto &)
                             TALUS_INLINE_LAMBDA { return left_stretch(F); });
          return;
        }
    set_stretch<dim>(points.view(),
                     begin,
                     end,
                     [](const auto &F, const auto &L) TALUS_INLINE_LAMBDA {
                       return lengths_of_rows<dim>(F, L);
                     });
  }



  // The initial deformation of a body does not count as deformation since the
  // creation of its points: the splitter compares with the initial stretch.
  template <int dim>
  void
  initialize_stretch(Points<dim>       &points,
                     const unsigned int begin,
                     const unsigned int end,
                     const BoxRule      rule)
  {
    update_stretch(points, begin, end, rule);
    const PointsView<dim, const double> columns =
      static_cast<const Points<dim> &>(points).view();
    for (unsigned int p = begin; p < end; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points.data(points.creation_stretch, d)[p] =
          stretch_to_split<double>(columns, rule, d, p);
  }



  template <int dim>
  Tensor<1, dim>
  edge_of_cell(const Points<dim> &points,
               const unsigned int k,
               const unsigned int p)
  {
    const double   L = points.data(points.reference_length, k)[p];
    Tensor<1, dim> edge;
    for (unsigned int i = 0; i < dim; ++i)
      edge[i] = points.data(points.deformation_gradient, dim * i + k)[p] * L;
    return edge;
  }



  template <int dim>
  Tensor<1, dim>
  edge_of_box(const Points<dim> &points,
              const BoxRule      rule,
              const unsigned int d,
              const unsigned int p)
  {
    if (rule == BoxRule::convected_domain)
      return edge_of_cell(points, d, p);
    Tensor<1, dim> edge;
    edge[d] = points.data(points.reference_length, d)[p] *
              points.data(points.stretch, d)[p];
    return edge;
  }



  template <int dim>
  Tensor<1, dim>
  edge_to_split(const Points<dim> &points,
                const BoxRule      rule,
                const unsigned int d,
                const unsigned int p)
  {
    return rule == BoxRule::left_stretch ? edge_of_box(points, rule, d, p)
                                         : edge_of_cell(points, d, p);
  }



  namespace
  {
    /// Number of axes along which the box of point @p p exceeds the limits of
    /// half_length_in_cells(); @p size is the cell size, m.
    template <int dim>
    unsigned int
    count_clipped_axes(const Points<dim> &points,
                       const BoxShape    &shape,
                       const double       size,
                       const unsigned int p)
    {
      unsigned int n_clipped = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double half = 0.5 * edge_of_box(points, shape.rule, d, p)[d];
          if (half < shape.min_half * size || half > shape.max_half * size)
            ++n_clipped;
        }
      return n_clipped;
    }
  } // namespace



  // For a column of the statistics: where many boxes are clipped, boxes overlap
  // or leave gaps, and points should have been split.
  template <int dim>
  unsigned long
  count_clipped_boxes(const Points<dim> &points,
                      const Grid<dim>   &grid,
                      const BoxShape    &shape)
  {
    unsigned long n_clipped = 0;
    points.for_each_point([&](const Segment &segment, const unsigned int p) {
      if (shape.rule == BoxRule::convected_domain)
        n_clipped += ConvectedDomain<dim>(points, grid, shape, segment.cell, p)
                       .n_clipped();
      else
        n_clipped +=
          count_clipped_axes(points, shape, grid.cells()[segment.cell].size, p);
    });
    return n_clipped;
  }



  template decltype(update_stretch<2>)      update_stretch<2>;
  template decltype(update_stretch<3>)      update_stretch<3>;
  template decltype(initialize_stretch<2>)  initialize_stretch<2>;
  template decltype(initialize_stretch<3>)  initialize_stretch<3>;
  template decltype(edge_of_cell<2>)        edge_of_cell<2>;
  template decltype(edge_of_cell<3>)        edge_of_cell<3>;
  template decltype(edge_to_split<2>)       edge_to_split<2>;
  template decltype(edge_to_split<3>)       edge_to_split<3>;
  template decltype(edge_of_box<2>)         edge_of_box<2>;
  template decltype(edge_of_box<3>)         edge_of_box<3>;
  template decltype(count_clipped_boxes<2>) count_clipped_boxes<2>;
  template decltype(count_clipped_boxes<3>) count_clipped_boxes<3>;
} // namespace talus

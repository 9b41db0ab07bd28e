// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/box_rule.h>
#include <talus/transfer/convected_domain.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Diagonal of the symmetric factor U of F = R U; for F^T, the diagonal of
    /// V of F = V R. In 2-D U = (C + J I)/sqrt(tr C + 2 J), C = F^T F,
    /// @cite hoger1984. No eigenvectors, hence no special case for equal
    /// eigenvalues.
    template <typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, 2>
    stretch_diagonal(const Matrix<2, Number> &F, const Number J)
    {
      const Number C_00  = F[0][0] * F[0][0] + F[1][0] * F[1][0];
      const Number C_11  = F[0][1] * F[0][1] + F[1][1] * F[1][1];
      const Number scale = 1. / sqrt(C_00 + C_11 + 2. * J);
      return {{(C_00 + J) * scale, (C_11 + J) * scale}};
    }



    /// Diagonal of the symmetric factor U of F = R U in 3-D. The rotation comes
    /// from Newton's iteration R <- (R + R^-T)/2, which converges quadratically
    /// from R = F, @cite higham1986. A closed form by eigenvalues of C loses
    /// digits for close eigenvalues, which most of the soil has. The iteration
    /// ends when all points of a register have converged, after about four
    /// iterations, fewer for small stretches.
    template <typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, 3>
    stretch_diagonal(const Matrix<3, Number> &F, const Number /*J*/)
    {
      Matrix<3, Number> R = F;
      for (unsigned int iteration = 0; iteration < 40; ++iteration)
        {
          const Matrix<3, Number> inverse_R = inverse(R);
          Number                  change{};
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              {
                const Number step = 0.5 * (inverse_R[j][i] - R[i][j]);
                R[i][j] += step;
                change += step * step;
              }
          // The next change is of the order of the square of this change.
          if (!any(change > Number(1e-16)))
            break;
        }
      std::array<Number, 3> diagonal;
      for (unsigned int d = 0; d < 3; ++d)
        // U = R^T F.
        diagonal[d] = R[0][d] * F[0][d] + R[1][d] * F[1][d] + R[2][d] * F[2][d];
      return diagonal;
    }



    /// Diagonal of V of F = V R.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        left_stretch(const Matrix<dim, Number> &F)
    {
      Matrix<dim, Number> transpose;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          transpose[i][j] = F[j][i];
      return stretch_diagonal(transpose, determinant(F));
    }



    /// Stretches |F e_d| of the edges of the cell.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        lengths_of_columns(const Matrix<dim, Number> &F)
    {
      std::array<Number, dim> length;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Number square = F[0][d] * F[0][d];
          for (unsigned int i = 1; i < dim; ++i)
            square += F[i][d] * F[i][d];
          length[d] = sqrt(square);
        }
      return length;
    }



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



    /// Set the stretch of the points [begin, end) to stretch_of(F, L). (Rules
    /// that share a loop share subexpressions and therefore round-off.)
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



  template <int dim>
  void
  update_stretch(Points<dim>       &points,
                 const unsigned int begin,
                 const unsigned int end,
                 const BoxRule      rule)
  {
    const auto columns = points.view();
    switch (rule)
      {
        case BoxRule::fixed:
          break;
        case BoxRule::left_stretch:
          set_stretch<dim>(columns,
                           begin,
                           end,
                           [](const auto &F, const auto &)
                             TALUS_INLINE_LAMBDA { return left_stretch(F); });
          break;
        case BoxRule::second_moments:
          set_stretch<dim>(columns,
                           begin,
                           end,
                           [](const auto &F, const auto &L) TALUS_INLINE_LAMBDA {
                             return lengths_of_rows<dim>(F, L);
                           });
          break;
        case BoxRule::convected_domain:
          set_stretch<dim>(columns,
                           begin,
                           end,
                           [](const auto &F, const auto &) TALUS_INLINE_LAMBDA {
                             return lengths_of_columns<dim>(F);
                           });
      }
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
    edge[d] = points.data(points.reference_length, d)[p];
    if (rule != BoxRule::fixed)
      edge[d] *= points.data(points.stretch, d)[p];
    return edge;
  }



  template <int dim>
  Tensor<1, dim>
  edge_to_split(const Points<dim> &points,
                const BoxRule      rule,
                const unsigned int d,
                const unsigned int p)
  {
    return rule == BoxRule::left_stretch ? edge_of_box(points, rule, d, p) :
                                           edge_of_cell(points, d, p);
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
          double half = 0.5 * points.data(points.reference_length, d)[p];
          if (shape.rule != BoxRule::fixed)
            half *= points.data(points.stretch, d)[p];
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/box_rule.h>
#include <talus/transfer/convected_domain.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Lengths of the box with the second moments, along the axes, of the cell
    /// with the edges A: the lengths of the rows of A, m.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        lengths_of_rows(const Matrix<dim, Number> &A)
    {
      std::array<Number, dim> length;
      for (unsigned int d = 0; d < dim; ++d)
        {
          Number square(0.);
          for (unsigned int k = 0; k < dim; ++k)
            square += A[d][k] * A[d][k];
          length[d] = sqrt(square);
        }
      return length;
    }



    /// Lengths of the smallest box around the cell with the edges A, m.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        extents(const Matrix<dim, Number> &A)
    {
      std::array<Number, dim> length;
      for (unsigned int d = 0; d < dim; ++d)
        {
          length[d] = Number(0.);
          for (unsigned int k = 0; k < dim; ++k)
            length[d] += max(A[d][k], -A[d][k]);
        }
      return length;
    }



    /// V_dd L of square points with F = V R and edges A = F L, m. In 2-D
    /// V L = (B + det A I)/sqrt(tr B + 2 det A) with B = A A^T,
    /// @cite hoger1984. No eigenvectors, hence no special case for equal
    /// eigenvalues. In 3-D the second moments are used: the paper, whose boxes
    /// follow V, is about plane strain.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
                        left_stretch(const Matrix<dim, Number> &A)
    {
      auto length = lengths_of_rows<dim>(A);
      if constexpr (dim == 2)
        {
          const Number volume = determinant(A);
          const Number B_00   = length[0] * length[0],
                       B_11   = length[1] * length[1];
          const Number scale  = 1. / sqrt(B_00 + B_11 + 2. * volume);
          length = {{(B_00 + volume) * scale, (B_11 + volume) * scale}};
        }
      return length;
    }



    /// Set the lengths of the boxes of the points [begin, end) to
    /// lengths_of(A).
    template <int dim, typename LengthsOf>
    TALUS_ALWAYS_INLINE void
    set_lengths(const PointsView<dim> &points,
                const unsigned int     begin,
                const unsigned int     end,
                const LengthsOf       &lengths_of)
    {
      for_each_simd(
        begin, end, [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
          const auto length = lengths_of(
            load_matrix<dim, decltype(number)>(points, points.edges, p));
          for (unsigned int d = 0; d < dim; ++d)
            store(points.data(points.box_length, d) + p, length[d]);
        });
    }
  } // namespace



  template <int dim>
  void
  update_box_lengths(Points<dim>       &points,
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
          set_lengths<dim>(columns,
                           begin,
                           end,
                           [](const auto &A) TALUS_INLINE_LAMBDA {
                             return left_stretch<dim>(A);
                           });
          break;
        case BoxRule::second_moments:
          set_lengths<dim>(columns,
                           begin,
                           end,
                           [](const auto &A) TALUS_INLINE_LAMBDA {
                             return lengths_of_rows<dim>(A);
                           });
          break;
        case BoxRule::convected_domain:
          set_lengths<dim>(columns,
                           begin,
                           end,
                           [](const auto &A)
                             TALUS_INLINE_LAMBDA { return extents<dim>(A); });
      }
  }



  // The initial deformation of a body does not count as deformation since the
  // creation of its points: the splitter compares with the initial lengths.
  template <int dim>
  void
  begin_stretch(Points<dim>       &points,
                const unsigned int begin,
                const unsigned int end,
                const BoxRule      rule)
  {
    update_box_lengths(points, begin, end, rule);
    const PointsView<dim, const double> columns = std::as_const(points).view();
    for (unsigned int p = begin; p < end; ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points.data(points.length_at_creation, d)[p] =
          length_to_split<double>(columns, rule, d, p);
  }



  template <int dim>
  Tensor<1, dim>
  reference_lengths(const Points<dim> &points, const unsigned int p)
  {
    auto   length = load_vector(points, points.length_at_creation, p);
    double volume = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      volume *= length[d];
    return std::pow(points.data(points.reference_volume)[p] / volume,
                    1. / dim) *
           length;
  }



  template <int dim>
  Tensor<1, dim>
  edge_of_cell(const Points<dim> &points,
               const unsigned int k,
               const unsigned int p)
  {
    Tensor<1, dim> edge;
    for (unsigned int i = 0; i < dim; ++i)
      edge[i] = points.data(points.edges, dim * i + k)[p];
    return edge;
  }



  template <int dim>
  Tensor<1, dim>
  edge_to_split(const Points<dim> &points,
                const BoxRule      rule,
                const unsigned int d,
                const unsigned int p)
  {
    if (rule != BoxRule::left_stretch)
      return edge_of_cell(points, d, p);
    Tensor<1, dim> edge;
    edge[d] = points.data(points.box_length, d)[p];
    return edge;
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
          const double half = 0.5 * points.data(points.box_length, d)[p];
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



  template decltype(update_box_lengths<2>)  update_box_lengths<2>;
  template decltype(update_box_lengths<3>)  update_box_lengths<3>;
  template decltype(begin_stretch<2>)       begin_stretch<2>;
  template decltype(begin_stretch<3>)       begin_stretch<3>;
  template decltype(reference_lengths<2>)   reference_lengths<2>;
  template decltype(reference_lengths<3>)   reference_lengths<3>;
  template decltype(edge_of_cell<2>)        edge_of_cell<2>;
  template decltype(edge_of_cell<3>)        edge_of_cell<3>;
  template decltype(edge_to_split<2>)       edge_to_split<2>;
  template decltype(edge_to_split<3>)       edge_to_split<3>;
  template decltype(count_clipped_boxes<2>) count_clipped_boxes<2>;
  template decltype(count_clipped_boxes<3>) count_clipped_boxes<3>;
} // namespace talus

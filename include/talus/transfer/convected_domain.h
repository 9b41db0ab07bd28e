// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_transfer_convected_domain_h
#define talus_transfer_convected_domain_h

#include <talus/grid/grid.h>
#include <talus/points/points.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_shape.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace talus
{
  /// Domain of a point that convects with the material (CPDI): the cell of the
  /// edges of the point, a parallelogram or parallelepiped. The shape functions
  /// are interpolated between their values at the corners; mean and mean
  /// gradient of the interpolation are the weights of the point.
  /// @cite sadeghirad2011
  template <int dim>
  class ConvectedDomain
  {
  public:
    static constexpr unsigned int n_corners = 1u << dim;

    /// Compute the domain of point @p p in @p cell, limited for the weights:
    /// - Opposite sides are at least twice `Minimum half-size` cells apart,
    ///   which keeps the step stable. A side that moves outwards leaves the
    ///   planes of the other sides unchanged.
    /// - Along each axis of the mesh the domain is scaled about its centre, so
    ///   that all corners lie in touching cells: no farther from the centre
    ///   than the size of the smallest touching cell.
    ConvectedDomain(const Points<dim> &points,
                    const Grid<dim>   &grid,
                    const BoxShape    &shape,
                    unsigned int       cell,
                    unsigned int       p);

    /// Position of corner @p v, m. Bit d of @p v is set at the upper end of
    /// edge d.
    dealii::Point<dim>
    corner(unsigned int v) const;

    /// Factor of corner @p v in the mean gradient, 1/m: the mean gradient of a
    /// shape function is the sum over corners of value times factor.
    dealii::Tensor<1, dim>
    gradient_factor(unsigned int v) const;

    /// Number of limits applied: pairs of sides pushed apart plus axes scaled.
    unsigned int
    n_clipped() const
    {
      return n_clipped_;
    }

  private:
    void
    set_edges(const PointsView<dim, const double> &points, unsigned int p);
    void
    widen(double min_half_width);
    void
    shrink(double max_half_extent);

    dealii::Point<dim>                      centre_;
    std::array<dealii::Tensor<1, dim>, dim> half_edge_; ///< m
    /// Unit normals of the sides divided by the half widths: row d times half
    /// edge e is 1 for d = e, otherwise 0.
    std::array<dealii::Tensor<1, dim>, dim> dual_; ///< 1/m
    unsigned int                            n_clipped_ = 0;
  };



  /// Shape functions at a position, for the nodes of the cell around the
  /// position.
  template <int dim>
  struct NodesAround
  {
    std::array<unsigned int, 1 << dim> node;
    std::array<double, 1 << dim>       value;
  };



  /// Size of the smallest cell among @p c and the cells touching it, m. Cell
  /// @p c must not be uniform.
  template <int dim>
  double
  smallest_size_around(const Grid<dim> &grid, unsigned int c);

  /// Move @p x, m, to the nearest position in the mesh. Return the cell nearest
  /// to @p x among @p c and the cells touching @p c. Cell @p c must not be
  /// uniform.
  template <int dim>
  const Cell<dim> &
  touching_cell_at(const Grid<dim>    &grid,
                   unsigned int        c,
                   dealii::Point<dim> &x);



  // The bodies below are inline: the functions group twice per step for each
  // corner of each point.

  template <int dim>
  TALUS_ALWAYS_INLINE
  ConvectedDomain<dim>::ConvectedDomain(const Points<dim> &points,
                                        const Grid<dim>   &grid,
                                        const BoxShape    &shape,
                                        const unsigned int cell,
                                        const unsigned int p)
  {
    const Cell<dim> &own = grid.cells()[cell];
    set_edges(points.view(), p);
    widen(shape.min_half * own.size);
    shrink(2. * shape.max_half *
           (own.uniform ? own.size : smallest_size_around(grid, cell)));
  }



  template <int dim>
  TALUS_ALWAYS_INLINE void
  ConvectedDomain<dim>::set_edges(const PointsView<dim, const double> &points,
                                  const unsigned int                   p)
  {
    Matrix<dim, double> half_edges;
    for (unsigned int d = 0; d < dim; ++d)
      {
        centre_[d] = points.data(points.position, d)[p];
        for (unsigned int i = 0; i < dim; ++i)
          half_edge_[d][i] = half_edges[i][d] =
            0.5 * points.data(points.edges, dim * i + d)[p];
      }
    const auto dual = inverse(half_edges);
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < dim; ++i)
        dual_[d][i] = dual[d][i];
  }



  // Let n be the unit normal of the sides at the ends of edge d and w the half
  // width; row d of the dual basis is n/w. Adding (least - w) n to the half
  // edge makes the half width w = least. The dual basis follows from the
  // formula of Sherman and Morrison.
  template <int dim>
  TALUS_ALWAYS_INLINE void
  ConvectedDomain<dim>::widen(const double min_half_width)
  {
    const double max_square = 1. / (min_half_width * min_half_width);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double square = dual_[d].norm_square();
        if (square <= max_square)
          continue;
        ++n_clipped_;
        const double                 width = 1. / std::sqrt(square);
        const dealii::Tensor<1, dim> more =
          (min_half_width - width) * width * dual_[d];
        half_edge_[d] += more;
        const dealii::Tensor<1, dim> row = (width / min_half_width) * dual_[d];
        for (unsigned int e = 0; e < dim; ++e)
          if (e != d)
            dual_[e] -= (dual_[e] * more) * row;
        dual_[d] = row;
      }
  }



  template <int dim>
  TALUS_ALWAYS_INLINE void
  ConvectedDomain<dim>::shrink(const double max_half_extent)
  {
    for (unsigned int i = 0; i < dim; ++i)
      {
        double extent = 0;
        for (unsigned int d = 0; d < dim; ++d)
          extent += std::abs(half_edge_[d][i]);
        if (extent <= max_half_extent)
          continue;
        ++n_clipped_;
        for (unsigned int d = 0; d < dim; ++d)
          {
            half_edge_[d][i] *= max_half_extent / extent;
            dual_[d][i] *= extent / max_half_extent;
          }
      }
  }



  template <int dim>
  TALUS_ALWAYS_INLINE dealii::Point<dim>
                      ConvectedDomain<dim>::corner(const unsigned int v) const
  {
    dealii::Point<dim> x = centre_;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < dim; ++i)
        x[i] += ((v >> d) & 1 ? half_edge_[d][i] : -half_edge_[d][i]);
    return x;
  }



  // The mean derivative along edge d is the mean over the corners at the upper
  // end minus the mean over the corners at the lower end.
  template <int dim>
  TALUS_ALWAYS_INLINE dealii::Tensor<1, dim>
  ConvectedDomain<dim>::gradient_factor(const unsigned int v) const
  {
    dealii::Tensor<1, dim> factor;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int i = 0; i < dim; ++i)
        factor[i] += ((v >> d) & 1 ? dual_[d][i] : -dual_[d][i]);
    return factor * (1. / n_corners);
  }



  /// Shape functions at @p x, m, in cell @p c or a touching cell. Beyond the
  /// boundary of the mesh the shape functions are constant along the normal.
  template <int dim>
  TALUS_ALWAYS_INLINE NodesAround<dim>
                      nodes_around(const Grid<dim>   &grid,
                                   const unsigned int c,
                                   dealii::Point<dim> x)
  {
    const Cell<dim> *cell       = &grid.cells()[c];
    unsigned int     first      = 0; // index in the patch
    double           lower      = 0.;
    const bool       is_uniform = cell->uniform;
    if (!is_uniform)
      cell = &touching_cell_at(grid, c, x);
    const double inverse_size = 1. / cell->size;
    double       xi[dim];
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double t = (x[d] - cell->lower[d]) * inverse_size;
        // The patch continues the cells beyond the boundary and contains the
        // nodes across a periodic face.
        if (is_uniform)
          lower = std::clamp(std::floor(t), -1., 1.);
        first += static_cast<unsigned int>(lower + 1.) * power(4, d);
        xi[d] = std::clamp(t - lower, 0., 1.);
      }
    NodesAround<dim> around;
    for (unsigned int n = 0; n < around.node.size(); ++n)
      {
        unsigned int at = first;
        double       N  = 1.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = (n >> d) & 1;
            at += i * power(4, d);
            N *= (i == 1 ? xi[d] : 1. - xi[d]);
          }
        around.node[n]  = cell->patch[at];
        around.value[n] = N;
      }
    return around;
  }
} // namespace talus

#endif

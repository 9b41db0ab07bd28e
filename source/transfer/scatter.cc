// Points to grid.

#include <talus/transfer/block.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// What each point of a block gives to its nodes: the first register is
    /// multiplied by the weight, register 1 + d by component d of its gradient.
    template <int dim>
    using Contributions =
      std::array<std::array<Lanes, 1 + dim>, Block<dim>::n_points>;



    /// Cauchy stress of point p with the mean over its cell.
    template <int dim>
    inline Matrix<dim, double>
    averaged_stress(Points<dim> &points, const unsigned int p)
    {
      Matrix<dim, double> sigma;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          sigma[i][j] = points.data(points.stress, stress_index<dim>(i, j))[p] +
                        (i == j ? points.mean_stress_shift()[p] : 0.);
      return sigma;
    }



    /// f_i = -sum_p V_p sigma_p . grad S_ip + sum_p m_p b_p S_ip, and the sums
    /// of mass, momentum and reference volume. @cite bardenhagen2004, eq. 19 ff.
    template <int dim>
    inline std::array<Lanes, 1 + dim>
    contribution_of_point(Points<dim>                   &points,
                          const unsigned int             p,
                          const std::array<double, dim> &acceleration)
    {
      using Sum            = NodalSum<dim>;
      const double mass    = points.data(points.mass)[p];
      const double volume0 = points.data(points.reference_volume)[p];
      const double volume =
        volume0 *
        determinant(
          load_matrix<dim, double>(points, points.deformation_gradient, p));
      const Matrix<dim, double> sigma = averaged_stress(points, p);

      std::array<Lanes, 1 + dim> r{};
      r[0][Sum::mass]   = mass;
      r[0][Sum::volume] = volume0;
      for (unsigned int i = 0; i < dim; ++i)
        {
          r[0][Sum::momentum + i] = mass * points.data(points.velocity, i)[p];
          r[0][Sum::force + i]    = mass * acceleration[i];
          for (unsigned int d = 0; d < dim; ++d)
            r[1 + d][Sum::force + i] = -volume * sigma[i][d];
        }
      return r;
    }



    template <int dim>
    void
    stage(Points<dim>        &points,
          const Block<dim>   &block,
          Contributions<dim> &contributions)
    {
      for (unsigned int k = 0; k < block.size; ++k)
        {
          std::array<double, dim> acceleration;
          for (unsigned int d = 0; d < dim; ++d)
            acceleration[d] = block.body_acceleration[d][k];
          contributions[k] =
            contribution_of_point<dim>(points, block.begin + k, acceleration);
        }
    }



    /// Sum over the points of a piece for the nodes of its patch. The sums stay
    /// in registers in 2-D: 16 nodes, one register each.
    void
    accumulate(const Block<2>         &block,
               const Contributions<2> &contributions,
               const Piece            &piece,
               std::array<Lanes, 16>  &sum)
    {
      for (unsigned int k = piece.begin; k < piece.end; ++k)
        {
          const auto &r = contributions[k];
          Lanes       P[4], Q[4];
          for (unsigned int i = 0; i < 4; ++i)
            {
              P[i] =
                block.value[0][i][k] * r[0] + block.gradient[0][i][k] * r[1];
              Q[i] = block.value[0][i][k] * r[2];
            }
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int i = 0; i < 4; ++i)
              sum[4 * j + i] +=
                block.value[1][j][k] * P[i] + block.gradient[1][j][k] * Q[i];
        }
    }



    void
    accumulate(const Block<3>         &block,
               const Contributions<3> &contributions,
               const Piece            &piece,
               std::array<Lanes, 64>  &sum)
    {
      for (unsigned int k = piece.begin; k < piece.end; ++k)
        {
          const auto &r = contributions[k];
          Lanes       P[4], Q[4], T[4];
          for (unsigned int i = 0; i < 4; ++i)
            {
              P[i] =
                block.value[0][i][k] * r[0] + block.gradient[0][i][k] * r[1];
              Q[i] = block.value[0][i][k] * r[2];
              T[i] = block.value[0][i][k] * r[3];
            }
          for (unsigned int j = 0; j < 4; ++j)
            for (unsigned int i = 0; i < 4; ++i)
              {
                const Lanes A =
                  block.value[1][j][k] * P[i] + block.gradient[1][j][k] * Q[i];
                const Lanes B = block.value[1][j][k] * T[i];
                for (unsigned int l = 0; l < 4; ++l)
                  sum[16 * l + 4 * j + i] +=
                    block.value[2][l][k] * A + block.gradient[2][l][k] * B;
              }
        }
    }



    /// Cells whose neighbours differ in size.
    template <int dim>
    void
    scatter_general(Points<dim>      &points,
                    const Grid<dim>  &grid,
                    const Loads<dim> &loads,
                    const BoxShape   &shape,
                    const Segment    &segment,
                    NodalFields<dim> &nodes)
    {
      std::vector<NodeWeight<dim>> weights;
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          weights_of_point(points, grid, shape, segment.cell, p, weights);
          std::array<double, dim> acceleration;
          for (unsigned int d = 0; d < dim; ++d)
            acceleration[d] =
              loads.acceleration_of_body[segment.body][d] +
              (loads.varies ? points.body_acceleration(d)[p] : 0.);
          const auto r = contribution_of_point<dim>(points, p, acceleration);
          for (const auto &w : weights)
            {
              Lanes sum = load<Lanes>(nodes.sum(w.node)) + w.value * r[0];
              for (unsigned int d = 0; d < dim; ++d)
                sum += w.gradient[d] * r[1 + d];
              store(nodes.sum(w.node), sum);
            }
        }
    }
  } // namespace



  template <int dim>
  void
  Transfer<dim>::scatter(Points<dim>      &points,
                         const Grid<dim>  &grid,
                         const Loads<dim> &loads,
                         NodalFields<dim> &nodes) const
  {
    Block<dim>         block;
    Contributions<dim> contributions;
    BlockWalk<dim>     walk(points, grid, loads, box_shape_);
    while (walk.next(block))
      {
        stage(points, block, contributions);
        for (unsigned int i = 0; i < block.n_pieces; ++i)
          {
            std::array<Lanes, power(4, dim)> sum{};
            accumulate(block, contributions, block.pieces[i], sum);
            const auto &patch = grid.cells()[block.pieces[i].cell].patch;
            for (unsigned int n = 0; n < sum.size(); ++n)
              store(nodes.sum(patch[n]),
                    load<Lanes>(nodes.sum(patch[n])) + sum[n]);
          }
      }
    for (const Segment &segment : points.segments())
      if (!grid.cells()[segment.cell].uniform)
        scatter_general(points, grid, loads, box_shape_, segment, nodes);
  }



  template void
  Transfer<2>::scatter(Points<2> &,
                       const Grid<2> &,
                       const Loads<2> &,
                       NodalFields<2> &) const;
  template void
  Transfer<3>::scatter(Points<3> &,
                       const Grid<3> &,
                       const Loads<3> &,
                       NodalFields<3> &) const;
} // namespace talus

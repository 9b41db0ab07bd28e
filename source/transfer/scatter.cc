// Points to grid.

#include <talus/transfer/block.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// What a point gives to its nodes. `by_weight` is laid out as a NodalSum
    /// and multiplied by the weight; `flux` is -V sigma in the order of the
    /// stress, and its row d is multiplied by component d of the gradient.
    struct Contribution
    {
      Lanes by_weight;
      Lanes flux;
    };

    template <int dim>
    using Contributions = std::array<Contribution, Block<dim>::n_points>;



    /// Row @p d of the flux where NodalSum has the force.
    template <int dim, int d>
    inline Lanes
    force_by_gradient(const Lanes &flux)
    {
      constexpr int zero = n_lanes;
      if constexpr (dim == 2)
        return __builtin_shufflevector(flux,
                                       Lanes{},
                                       zero,
                                       zero,
                                       zero,
                                       stress_index<2>(d, 0),
                                       stress_index<2>(d, 1),
                                       zero,
                                       zero,
                                       zero);
      else
        return __builtin_shufflevector(flux,
                                       Lanes{},
                                       zero,
                                       zero,
                                       zero,
                                       zero,
                                       stress_index<3>(d, 0),
                                       stress_index<3>(d, 1),
                                       stress_index<3>(d, 2),
                                       zero);
    }

    static_assert(NodalSum<2>::force == 3 && NodalSum<3>::force == 4);



    /// f_i = -sum_p V_p sigma_p . grad S_ip + sum_p m_p b_p S_ip, and the sums
    /// of mass, momentum and reference volume, for the points @p p and
    /// following: entry by entry, point by lane. The stress has the mean over
    /// its cell. @cite bardenhagen2004, eq. 19 ff.
    template <int dim>
    inline void
    set_contributions(Points<dim>       &points,
                      const unsigned int p,
                      const unsigned int body,
                      const Loads<dim>  &loads,
                      Lanes (&by_weight)[n_lanes],
                      Lanes (&flux)[n_lanes])
    {
      using Sum        = NodalSum<dim>;
      const Lanes mass = load<Lanes>(points.data(points.mass) + p);
      const Lanes volume0 =
        load<Lanes>(points.data(points.reference_volume) + p);
      const Lanes J = determinant(
        load_matrix<dim, Lanes>(points, points.deformation_gradient, p));
      const Lanes shift =
        load<Lanes>(points.mean_stress_shift() + p - points.workspace_begin());
      by_weight[Sum::mass]   = mass;
      by_weight[Sum::volume] = volume0;
      for (unsigned int i = 0; i < dim; ++i)
        {
          by_weight[Sum::momentum + i] =
            mass * load<Lanes>(points.data(points.velocity, i) + p);
          by_weight[Sum::force + i] =
            mass * loads.template acceleration<Lanes>(body, p, i);
        }
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          {
            constexpr auto index = stress_index<dim>;
            const Lanes    sigma =
              load<Lanes>(points.data(points.stress, index(i, j)) + p);
            flux[index(i, j)] = -volume0 * J * (i == j ? sigma + shift : sigma);
          }
    }



    /// The contributions of all points of the block, one after the other.
    template <int dim>
    void
    stage(Points<dim>        &points,
          const Block<dim>   &block,
          const Loads<dim>   &loads,
          Contributions<dim> &contributions)
    {
      for (unsigned int k = 0; k < block.size; k += n_lanes)
        {
          Lanes by_weight[n_lanes] = {}, flux[n_lanes] = {};
          set_contributions(
            points, block.begin + k, block.body, loads, by_weight, flux);
          transpose(by_weight);
          transpose(flux);
          for (unsigned int i = 0; i < n_lanes; ++i)
            contributions[k + i] = {by_weight[i], flux[i]};
        }
    }



    inline void
    add(double      *to,
        const Lanes &a,
        const double x,
        const Lanes &b,
        const double y)
    {
      // Term by term: each is one fused multiply-add.
      Lanes sum = load<Lanes>(to) + x * a;
      sum += y * b;
      store(to, sum);
    }



    /// Add what point @p k of the block gives to its nodes, the first of which
    /// is @p patch[0].
    inline void
    add_point(const Block<2>     &block,
              const unsigned int  k,
              const Contribution &given,
              const unsigned int *patch,
              NodalFields<2>     &nodes)
    {
      const Lanes f_x = force_by_gradient<2, 0>(given.flux);
      const Lanes f_y = force_by_gradient<2, 1>(given.flux);
      Lanes       P[3], Q[3];
      for (unsigned int i = 0; i < 3; ++i)
        {
          P[i] = block.value[0][i][k] * given.by_weight +
                 block.gradient[0][i][k] * f_x;
          Q[i] = block.value[0][i][k] * f_y;
        }
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          add(nodes.sum(patch[4 * j + i]),
              P[i],
              block.value[1][j][k],
              Q[i],
              block.gradient[1][j][k]);
    }



    inline void
    add_point(const Block<3>     &block,
              const unsigned int  k,
              const Contribution &given,
              const unsigned int *patch,
              NodalFields<3>     &nodes)
    {
      const Lanes f_x = force_by_gradient<3, 0>(given.flux);
      const Lanes f_y = force_by_gradient<3, 1>(given.flux);
      const Lanes f_z = force_by_gradient<3, 2>(given.flux);
      Lanes       P[3], Q[3], T[3];
      for (unsigned int i = 0; i < 3; ++i)
        {
          P[i] = block.value[0][i][k] * given.by_weight +
                 block.gradient[0][i][k] * f_x;
          Q[i] = block.value[0][i][k] * f_y;
          T[i] = block.value[0][i][k] * f_z;
        }
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const Lanes A =
              block.value[1][j][k] * P[i] + block.gradient[1][j][k] * Q[i];
            const Lanes B = block.value[1][j][k] * T[i];
            for (unsigned int l = 0; l < 3; ++l)
              add(nodes.sum(patch[16 * l + 4 * j + i]),
                  A,
                  block.value[2][l][k],
                  B,
                  block.gradient[2][l][k]);
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
          Lanes by_weight[n_lanes] = {}, flux[n_lanes] = {};
          set_contributions(points, p, segment.body, loads, by_weight, flux);
          transpose(by_weight);
          transpose(flux);
          std::array<Lanes, dim> force;
          force[0]       = force_by_gradient<dim, 0>(flux[0]);
          force[1]       = force_by_gradient<dim, 1>(flux[0]);
          force[dim - 1] = force_by_gradient<dim, dim - 1>(flux[0]);
          for (const auto &w : weights)
            {
              Lanes sum =
                load<Lanes>(nodes.sum(w.node)) + w.value * by_weight[0];
              for (unsigned int d = 0; d < dim; ++d)
                sum += w.gradient[d] * force[d];
              store(nodes.sum(w.node), sum);
            }
        }
    }
  } // namespace



  template <int dim>
  void
  Transfer<dim>::scatter(Points<dim>      &points,
                         const Batch      &batch,
                         const Grid<dim>  &grid,
                         const Loads<dim> &loads,
                         NodalFields<dim> &nodes) const
  {
    Block<dim>         block;
    Contributions<dim> contributions;
    BlockWalk<dim>     walk(points, batch, grid, box_shape_);
    while (walk.next(block))
      {
        prefetch_nodes(block, grid, [&](const unsigned int node) {
          return nodes.sum(node);
        });
        stage(points, block, loads, contributions);
        for (unsigned int i = 0; i < block.n_pieces; ++i)
          {
            const Piece &piece = block.pieces[i];
            const auto  *patch = grid.cells()[piece.cell].patch.data();
            for (unsigned int k = piece.begin; k < piece.end; ++k)
              add_point(
                block, k, contributions[k], patch + block.first_node[k], nodes);
          }
      }
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      if (const Segment &segment = points.segments()[s];
          !grid.cells()[segment.cell].uniform)
        scatter_general(points, grid, loads, box_shape_, segment, nodes);
  }



  template void
  Transfer<2>::scatter(Points<2> &,
                       const Batch &,
                       const Grid<2> &,
                       const Loads<2> &,
                       NodalFields<2> &) const;
  template void
  Transfer<3>::scatter(Points<3> &,
                       const Batch &,
                       const Grid<3> &,
                       const Loads<3> &,
                       NodalFields<3> &) const;
} // namespace talus

// Points to grid.

#include <talus/transfer/block.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// What a point gives to its nodes. `by_weight` is laid out as a NodalSum
    /// and multiplied by the weight. `flux` belongs to the gradient: in 3-D it is
    /// -V sigma in the order of the stress, row d of which is multiplied by
    /// component d; in 2-D row 0 where NodalSum has the force, while row 1 has
    /// places of its own in `by_weight`.
    struct Contribution
    {
      Lanes by_weight;
      Lanes flux;
    };

    template <int dim>
    using Contributions = std::array<Contribution, Block<dim>::n_points>;



    /// Row @p d of the flux where NodalSum has the force.
    template <int d>
    inline Lanes
    force_by_gradient(const Lanes &flux)
    {
      static_assert(NodalSum<3>::force == 4);
      constexpr int zero = n_lanes;
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



    /// What multiplies an entry of NodalSum<2>: @p value, or @p gradient where
    /// the part of the force by the gradient along y is.
    inline Lanes
    along_y(const double value, const double gradient)
    {
      static_assert(NodalSum<2>::force_by_y == 6);
      constexpr LaneMask by_gradient = {0, 0, 0, 0, 0, 0, -1, -1};
      return by_gradient ? broadcast<Lanes>(gradient) : broadcast<Lanes>(value);
    }



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
            const Lanes given = -volume0 * J * (i == j ? sigma + shift : sigma);
            if constexpr (dim == 3)
              flux[index(i, j)] = given;
            else
              {
                if (i == 0)
                  flux[Sum::force + j] = given;
                if (j == 1)
                  by_weight[Sum::force_by_y + i] = given;
              }
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



    /// Add what point @p k of the block gives to its nodes. The gradient along y
    /// multiplies entries of their own, so that each node takes one fused
    /// multiply-add.
    inline void
    add_point(const Block<2>     &block,
              const unsigned int  k,
              const Contribution &given,
              double             *sums)
    {
      const unsigned int *patch = block.nodes[k];
      Lanes               x[3], y[3];
      for (unsigned int i = 0; i < 3; ++i)
        {
          x[i] = block.value[0][i][k] * given.by_weight +
                 block.gradient[0][i][k] * given.flux;
          y[i] = along_y(block.value[1][i][k], block.gradient[1][i][k]);
        }
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            double *sum = sums + n_lanes * std::size_t(patch[4 * j + i]);
            store(sum, load<Lanes>(sum) + x[i] * y[j]);
          }
    }



    inline void
    add_weighted(const NodeWeight<2> &w,
                 const Contribution  &given,
                 double              *sums)
    {
      double *sum = sums + n_lanes * std::size_t(w.node);
      store(sum,
            load<Lanes>(sum) +
              along_y(w.value, w.gradient[1]) * given.by_weight +
              w.gradient[0] * given.flux);
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



    inline void
    add_point(const Block<3>     &block,
              const unsigned int  k,
              const Contribution &given,
              double             *sums)
    {
      const unsigned int *patch = block.nodes[k];
      const Lanes         f_x   = force_by_gradient<0>(given.flux);
      const Lanes         f_y   = force_by_gradient<1>(given.flux);
      const Lanes         f_z   = force_by_gradient<2>(given.flux);
      Lanes               P[3], Q[3], T[3];
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
              add(sums + n_lanes * std::size_t(patch[16 * l + 4 * j + i]),
                  A,
                  block.value[2][l][k],
                  B,
                  block.gradient[2][l][k]);
          }
    }



    inline void
    add_weighted(const NodeWeight<3> &w,
                 const Contribution  &given,
                 double              *sums)
    {
      double     *sum  = sums + n_lanes * std::size_t(w.node);
      const Lanes flux = w.gradient[0] * force_by_gradient<0>(given.flux) +
                         w.gradient[1] * force_by_gradient<1>(given.flux) +
                         w.gradient[2] * force_by_gradient<2>(given.flux);
      store(sum, load<Lanes>(sum) + w.value * given.by_weight + flux);
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
          for (const auto &w : weights)
            add_weighted(w, {by_weight[0], flux[0]}, nodes.sum(0));
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
    double *const      sums = nodes.sum(0);
    Block<dim>         block;
    Contributions<dim> contributions;
    BlockWalk<dim>     walk(points, batch, grid, box_shape_);
    while (walk.next(block))
      {
        prefetch_nodes(block, [&](const unsigned int node) {
          return nodes.sum(node);
        });
        stage(points, block, loads, contributions);
        for (unsigned int k = 0; k < block.size; ++k)
          {
            points.fetch_ahead(block.begin + k, points.elastic_energy);
            add_point(block, k, contributions[k], sums);
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

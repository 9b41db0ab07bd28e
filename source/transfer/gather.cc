// Grid to points.

#include <talus/transfer/block.h>
#include <talus/transfer/transfer.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    using Record = typename MotionRecord<dim>::type;

    /// What the nodes tell the points of a block: velocity and its increment,
    /// and the velocity gradient.
    template <int dim>
    struct Told
    {
      using Row = typename Block<dim>::Row;
      alignas(64) std::array<Row, dim> velocity;
      alignas(64) std::array<Row, dim> increment;
      alignas(64) std::array<std::array<Row, dim>, dim> gradient;
    };



    template <int dim>
    inline void
    tell_point(const Record<dim>                  &motion,
               const std::array<Record<dim>, dim> &gradient,
               const unsigned int                  k,
               Told<dim>                          &told)
    {
      using Motion = NodalMotion<dim>;
      for (unsigned int i = 0; i < dim; ++i)
        {
          told.velocity[i][k]  = motion[Motion::velocity + i];
          told.increment[i][k] = motion[Motion::increment + i];
          for (unsigned int d = 0; d < dim; ++d)
            told.gradient[i][d][k] = gradient[d][Motion::velocity + i];
        }
    }



    void
    interpolate(const Block<2>                  &block,
                const Piece                     &piece,
                const std::array<Record<2>, 16> &patch,
                Told<2>                         &told)
    {
      for (unsigned int k = piece.begin; k < piece.end; ++k)
        {
          Record<2>                motion{};
          std::array<Record<2>, 2> gradient{};
          for (unsigned int j = 0; j < 4; ++j)
            {
              Record<2> value{}, slope{};
              for (unsigned int i = 0; i < 4; ++i)
                {
                  value += block.value[0][i][k] * patch[4 * j + i];
                  slope += block.gradient[0][i][k] * patch[4 * j + i];
                }
              motion += block.value[1][j][k] * value;
              gradient[0] += block.value[1][j][k] * slope;
              gradient[1] += block.gradient[1][j][k] * value;
            }
          tell_point<2>(motion, gradient, k, told);
        }
    }



    void
    interpolate(const Block<3>                  &block,
                const Piece                     &piece,
                const std::array<Record<3>, 64> &patch,
                Told<3>                         &told)
    {
      for (unsigned int k = piece.begin; k < piece.end; ++k)
        {
          Record<3>                motion{};
          std::array<Record<3>, 3> gradient{};
          for (unsigned int l = 0; l < 4; ++l)
            {
              Record<3> value{}, slope_x{}, slope_y{};
              for (unsigned int j = 0; j < 4; ++j)
                {
                  Record<3> row{}, slope{};
                  for (unsigned int i = 0; i < 4; ++i)
                    {
                      const Record<3> &node = patch[16 * l + 4 * j + i];
                      row += block.value[0][i][k] * node;
                      slope += block.gradient[0][i][k] * node;
                    }
                  value += block.value[1][j][k] * row;
                  slope_x += block.value[1][j][k] * slope;
                  slope_y += block.gradient[1][j][k] * row;
                }
              motion += block.value[2][l][k] * value;
              gradient[0] += block.value[2][l][k] * slope_x;
              gradient[1] += block.value[2][l][k] * slope_y;
              gradient[2] += block.gradient[2][l][k] * value;
            }
          tell_point<3>(motion, gradient, k, told);
        }
    }



    /// v_p <- flip (v_p + dv) + (1 - flip) v(x_p), x_p <- x_p + dt v(x_p).
    /// Returns the work of the loads on the points: m b . (mean velocity) dt.
    template <int dim, typename Number>
    inline Number
    move_points(Points<dim>       &points,
                const Block<dim>  &block,
                const Told<dim>   &told,
                const unsigned int k,
                const double       flip,
                const double       dt)
    {
      const unsigned int p = block.begin + k;
      Number             power_of_loads{};
      for (unsigned int i = 0; i < dim; ++i)
        {
          const Number v    = load<Number>(&told.velocity[i][k]);
          const Number dv   = load<Number>(&told.increment[i][k]);
          double      *to_v = points.data(points.velocity, i) + p;
          double      *to_x = points.data(points.position, i) + p;
          store(to_v, flip * (load<Number>(to_v) + dv) + (1. - flip) * v);
          store(to_x, load<Number>(to_x) + dt * v);
          for (unsigned int d = 0; d < dim; ++d)
            store(points.velocity_gradient(i, d) + p,
                  load<Number>(&told.gradient[i][d][k]));
          power_of_loads +=
            load<Number>(&block.body_acceleration[i][k]) * (v - 0.5 * dv);
        }
      return dt * power_of_loads * load<Number>(points.data(points.mass) + p);
    }



    inline double
    sum(const double x)
    {
      return x;
    }



    inline double
    sum(const Lanes &x)
    {
      return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
    }



    /// Cells whose neighbours differ in size: fill the block's rows of one
    /// point from the weights by definition.
    template <int dim>
    void
    interpolate_general(const NodalFields<dim>             &nodes,
                        const std::vector<NodeWeight<dim>> &weights,
                        Told<dim>                          &told)
    {
      Record<dim>                  motion{};
      std::array<Record<dim>, dim> gradient{};
      for (const auto &w : weights)
        {
          const auto node = load<Record<dim>>(nodes.motion(w.node));
          motion += w.value * node;
          for (unsigned int d = 0; d < dim; ++d)
            gradient[d] += w.gradient[d] * node;
        }
      tell_point<dim>(motion, gradient, 0, told);
    }
  } // namespace



  template <int dim>
  double
  Transfer<dim>::gather(const NodalFields<dim> &nodes,
                        const Grid<dim>        &grid,
                        const Loads<dim>       &loads,
                        Points<dim>            &points,
                        const double            dt) const
  {
    double         work = 0;
    Block<dim>     block;
    Told<dim>      told;
    BlockWalk<dim> walk(points, grid, loads, box_shape_);
    while (walk.next(block))
      {
        for (unsigned int i = 0; i < block.n_pieces; ++i)
          {
            std::array<Record<dim>, power(4, dim)> motions;
            const auto &patch = grid.cells()[block.pieces[i].cell].patch;
            for (unsigned int n = 0; n < motions.size(); ++n)
              motions[n] = load<Record<dim>>(nodes.motion(patch[n]));
            interpolate(block, block.pieces[i], motions, told);
          }
        for_lanes(0, block.size, [&](const unsigned int k, const auto number) {
          using Number = std::decay_t<decltype(number)>;
          work += sum(move_points<dim, Number>(
            points, block, told, k, flip_fraction_, dt));
        });
      }

    std::vector<NodeWeight<dim>> weights;
    for (const Segment &segment : points.segments())
      if (!grid.cells()[segment.cell].uniform)
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            weights_of_point(
              points, grid, box_shape_, segment.cell, p, weights);
            interpolate_general(nodes, weights, told);
            block.begin = p;
            for (unsigned int d = 0; d < dim; ++d)
              block.body_acceleration[d][0] =
                loads.acceleration_of_body[segment.body][d] +
                (loads.varies ? points.body_acceleration(d)[p] : 0.);
            work += move_points<dim, double>(
              points, block, told, 0, flip_fraction_, dt);
          }
    return work;
  }



  template double
  Transfer<2>::gather(const NodalFields<2> &,
                      const Grid<2> &,
                      const Loads<2> &,
                      Points<2> &,
                      double) const;
  template double
  Transfer<3>::gather(const NodalFields<3> &,
                      const Grid<3> &,
                      const Loads<3> &,
                      Points<3> &,
                      double) const;
} // namespace talus

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

    /// What the nodes tell a point: registers of n_lanes entries, in which
    /// velocity, its increment and the velocity gradient have fixed places.
    template <int dim>
    struct Told;

    template <>
    struct Told<2>
    {
      std::array<Lanes, 1> registers;

      Told() = default;

      Told(const Record<2> &motion, const std::array<Record<2>, 2> &gradient)
      {
        const Record<2> L =
          __builtin_shufflevector(gradient[0], gradient[1], 0, 1, 4, 5);
        registers[0] =
          __builtin_shufflevector(motion, L, 0, 1, 2, 3, 4, 5, 6, 7);
      }

      static constexpr unsigned int velocity  = NodalMotion<2>::velocity;
      static constexpr unsigned int increment = NodalMotion<2>::increment;

      static constexpr unsigned int
      gradient(const unsigned int i, const unsigned int d)
      {
        return 4 + 2 * d + i;
      }
    };

    template <>
    struct Told<3>
    {
      std::array<Lanes, 4> registers;

      Told() = default;

      Told(const Record<3> &motion, const std::array<Record<3>, 3> &gradient)
        : registers{{motion, gradient[0], gradient[1], gradient[2]}}
      {}

      static constexpr unsigned int velocity  = NodalMotion<3>::velocity;
      static constexpr unsigned int increment = NodalMotion<3>::increment;

      static constexpr unsigned int
      gradient(const unsigned int i, const unsigned int d)
      {
        return n_lanes * (1 + d) + NodalMotion<3>::velocity + i;
      }
    };

    template <int dim>
    using ToldPoints = std::array<Told<dim>, Block<dim>::n_points>;



    /// The same entry by entry, for one point or for eight.
    template <int dim, typename Number>
    struct ToldEntries
    {
      std::array<Number, n_lanes * sizeof(Told<dim>) / sizeof(Lanes)> entry;

      explicit ToldEntries(const Told<dim> *told)
      {
        for (unsigned int r = 0; r < told->registers.size(); ++r)
          if constexpr (std::is_same_v<Number, Lanes>)
            {
              Lanes rows[n_lanes];
              for (unsigned int i = 0; i < n_lanes; ++i)
                rows[i] = told[i].registers[r];
              transpose(rows);
              for (unsigned int i = 0; i < n_lanes; ++i)
                entry[n_lanes * r + i] = rows[i];
            }
          else
            for (unsigned int i = 0; i < n_lanes; ++i)
              entry[n_lanes * r + i] = told->registers[r][i];
      }
    };



    /// What point @p k of the block is told by its nodes.
    inline Told<2>
    interpolate(const Block<2>       &block,
                const unsigned int    k,
                const NodalFields<2> &nodes)
    {
      const unsigned int      *patch = block.nodes[k];
      Record<2>                motion{};
      std::array<Record<2>, 2> gradient{};
      for (unsigned int j = 0; j < 3; ++j)
        {
          Record<2> value{}, slope{};
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto node = load<Record<2>>(nodes.motion(patch[4 * j + i]));
              value += block.value[0][i][k] * node;
              slope += block.gradient[0][i][k] * node;
            }
          motion += block.value[1][j][k] * value;
          gradient[0] += block.value[1][j][k] * slope;
          gradient[1] += block.gradient[1][j][k] * value;
        }
      return {motion, gradient};
    }



    inline Told<3>
    interpolate(const Block<3>       &block,
                const unsigned int    k,
                const NodalFields<3> &nodes)
    {
      const unsigned int      *patch = block.nodes[k];
      Record<3>                motion{};
      std::array<Record<3>, 3> gradient{};
      for (unsigned int l = 0; l < 3; ++l)
        {
          Record<3> value{}, slope_x{}, slope_y{};
          for (unsigned int j = 0; j < 3; ++j)
            {
              Record<3> row{}, slope{};
              for (unsigned int i = 0; i < 3; ++i)
                {
                  const auto node =
                    load<Record<3>>(nodes.motion(patch[16 * l + 4 * j + i]));
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
      return {motion, gradient};
    }



    /// v_p <- flip (v_p + dv) + (1 - flip) v(x_p), x_p <- x_p + dt v(x_p).
    /// Returns the work of the loads on the points: m b . (mean velocity) dt.
    template <int dim, typename Number>
    inline Number
    move_points(Points<dim>       &points,
                const unsigned int p,
                const unsigned int body,
                const Told<dim>   *told,
                const Loads<dim>  &loads,
                const double       flip,
                const double       dt)
    {
      using Place                            = Told<dim>;
      const unsigned int             in_work = p - points.workspace_begin();
      const ToldEntries<dim, Number> now(told);
      Number                         power_of_loads{};
      for (unsigned int i = 0; i < dim; ++i)
        {
          const Number v    = now.entry[Place::velocity + i];
          const Number dv   = now.entry[Place::increment + i];
          double      *to_v = points.data(points.velocity, i) + p;
          double      *to_x = points.data(points.position, i) + p;
          store(to_v, flip * (load<Number>(to_v) + dv) + (1. - flip) * v);
          store(to_x, load<Number>(to_x) + dt * v);
          for (unsigned int d = 0; d < dim; ++d)
            store(points.velocity_gradient(i, d) + in_work,
                  now.entry[Place::gradient(i, d)]);
          power_of_loads +=
            loads.template acceleration<Number>(body, p, i) * (v - 0.5 * dv);
        }
      return dt * power_of_loads * load<Number>(points.data(points.mass) + p);
    }



    /// Note point(s) @p p if they left the cell that begins at @p lower; one
    /// whose position is no number, too.
    template <int dim, typename Number>
    inline void
    note_strays(Points<dim>                   &points,
                const unsigned int             p,
                const std::array<Number, dim> &lower,
                const double                   cell_size)
    {
      auto inside = (lower[0] == lower[0]);
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto x = load<Number>(points.data(points.position, d) + p);
          inside &= (x >= lower[d]) & (x < lower[d] + cell_size);
        }
      if (__builtin_expect(all(inside), 1))
        return;
      for (unsigned int i = 0; i < sizeof(Number) / sizeof(double); ++i)
        if (!is_true(inside, i))
          points.strays().push_back(p + i);
    }



    /// Cells whose neighbours differ in size: what one point is told, by the
    /// weights as they are defined.
    template <int dim>
    Told<dim>
    interpolate_general(const NodalFields<dim>             &nodes,
                        const std::vector<NodeWeight<dim>> &weights)
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
      return {motion, gradient};
    }
  } // namespace



  template <int dim>
  double
  Transfer<dim>::gather(const NodalFields<dim> &nodes,
                        const Grid<dim>        &grid,
                        const Loads<dim>       &loads,
                        Points<dim>            &points,
                        const Batch            &batch,
                        const double            dt) const
  {
    double          work = 0;
    Lanes           work_of_lanes{};
    Block<dim>      block;
    ToldPoints<dim> told;
    BlockWalk<dim>  walk(points, batch, grid, box_shape_);
    while (walk.next(block))
      {
        prefetch_nodes(block, [&](const unsigned int node) {
          return nodes.motion(node);
        });
        for (unsigned int k = 0; k < block.size; ++k)
          {
            points.fetch_ahead(block.begin + k, points.initial_position);
            told[k] = interpolate(block, k, nodes);
          }
        for_lanes(0, block.size, [&](const unsigned int k, auto number) {
          using Number           = decltype(number);
          const Number work_here = move_points<dim, Number>(points,
                                                            block.begin + k,
                                                            block.body,
                                                            &told[k],
                                                            loads,
                                                            flip_fraction_,
                                                            dt);
          if constexpr (std::is_same_v<Number, Lanes>)
            work_of_lanes += work_here;
          else
            work += work_here;
          std::array<Number, dim> lower;
          for (unsigned int d = 0; d < dim; ++d)
            lower[d] = load<Number>(&block.cell_lower[d][k]);
          note_strays<dim, Number>(points,
                                   block.begin + k,
                                   lower,
                                   block.cell_size);
        });
      }
    work += gather_general(nodes, grid, loads, points, batch, dt);
    return work + sum_of_lanes(work_of_lanes);
  }



  template <int dim>
  double
  Transfer<dim>::gather_general(const NodalFields<dim> &nodes,
                                const Grid<dim>        &grid,
                                const Loads<dim>       &loads,
                                Points<dim>            &points,
                                const Batch            &batch,
                                const double            dt) const
  {
    double                       work = 0;
    std::vector<NodeWeight<dim>> weights;
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      {
        const Segment   &segment = points.segments()[s];
        const Cell<dim> &cell    = grid.cells()[segment.cell];
        if (cell.uniform)
          continue;
        std::array<double, dim> lower;
        for (unsigned int d = 0; d < dim; ++d)
          lower[d] = cell.lower[d];
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            weights_of_point(
              points, grid, box_shape_, segment.cell, p, weights);
            const Told<dim> told = interpolate_general(nodes, weights);
            work += move_points<dim, double>(
              points, p, segment.body, &told, loads, flip_fraction_, dt);
            note_strays<dim, double>(points, p, lower, cell.size);
          }
      }
    return work;
  }



  template double
  Transfer<2>::gather(const NodalFields<2> &,
                      const Grid<2> &,
                      const Loads<2> &,
                      Points<2> &,
                      const Batch &,
                      double) const;
  template double
  Transfer<3>::gather(const NodalFields<3> &,
                      const Grid<3> &,
                      const Loads<3> &,
                      Points<3> &,
                      const Batch &,
                      double) const;
} // namespace talus

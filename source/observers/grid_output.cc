#include <talus/grid/nodal_exchange.h>
#include <talus/observers/grid_output.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// The sums of all nodes this rank knows, those of ghosts from their owners;
    /// the whole force in one place.
    template <int dim>
    AlignedVector<double>
    sums_with_ghosts(const Snapshot<dim> &snapshot)
    {
      const std::size_t     n = n_lanes * std::size_t(snapshot.grid.n_nodes());
      AlignedVector<double> sums(n);
      std::copy_n(snapshot.nodes.sum(0), n, sums.begin());
      NodalExchange<dim> exchange;
      exchange.prepare(snapshot.grid, n_lanes);
      exchange.copy_to_ghosts(sums.data());
      using Sum = NodalSum<dim>;
      for (double *sum = sums.data(); sum != sums.data() + n; sum += n_lanes)
        for (unsigned int d = 0; d < dim; ++d)
          sum[Sum::force + d] = Sum::whole_force(sum, d);
      return sums;
    }



    template <int dim>
    std::vector<Field>
    node_fields(const NodalFields<dim>      &nodes,
                const AlignedVector<double> &sums)
    {
      using Sum = NodalSum<dim>;
      const auto add =
        [](const std::string &name, const unsigned int n, const auto &source) {
          return Field{name,
                       n == 1 ? FieldKind::scalar : FieldKind::vector,
                       n,
                       [n, source](const unsigned int node, float *values) {
                         for (unsigned int c = 0; c < n; ++c)
                           values[c] = source(node)[c];
                       }};
        };
      const double *first = sums.data();
      return {add("mass [kg]",
                  1,
                  [first](const unsigned int node) {
                    return first + n_lanes * std::size_t(node) + Sum::mass;
                  }),
              add("velocity [m/s]",
                  dim,
                  [&nodes](const unsigned int node) {
                    return nodes.motion(node) + NodalMotion<dim>::velocity;
                  }),
              add("force [N]", dim, [first](const unsigned int node) {
                return first + n_lanes * std::size_t(node) + Sum::force;
              })};
    }



    /// Corners of a cell in deal.II's order, and the nodes there.
    template <int dim>
    void
    add_cell(OutputCells<dim, dim> &cells, const Cell<dim> &cell)
    {
      for (unsigned int v = 0; v < cells.n_vertices; ++v)
        {
          unsigned int at     = 0;
          Point<dim>   corner = cell.lower;
          for (unsigned int d = 0; d < dim; ++d)
            {
              corner[d] += ((v >> d) & 1) * cell.size;
              at += (1 + ((v >> d) & 1)) * power(4, d);
            }
          cells.vertices.push_back(corner);
          cells.items.push_back(cell.patch[at]);
        }
    }
  } // namespace



  template <int dim>
  void
  GridOutput<dim>::begin(const std::filesystem::path &folder,
                         const MPI_Comm               communicator,
                         const FieldFormat            format,
                         const Beginning              beginning)
  {
    series_.begin(folder, "grid", communicator, format, beginning);
  }



  template <int dim>
  void
  GridOutput<dim>::list_state(StateList &list)
  {
    series_.list_state("files of grid", list);
  }



  template <int dim>
  void
  GridOutput<dim>::sync()
  {
    series_.sync();
  }



  template <int dim>
  void
  GridOutput<dim>::write(const Snapshot<dim> &snapshot)
  {
    const AlignedVector<double> sums = sums_with_ghosts(snapshot);
    OutputCells<dim, dim>       cells(node_fields(snapshot.nodes, sums),
                                ItemsAt::vertices);

    unsigned int previous = numbers::invalid_unsigned_int;
    for (const Segment &segment : snapshot.points.segments())
      if (segment.cell != previous)
        {
          add_cell(cells, snapshot.grid.cells()[segment.cell]);
          previous = segment.cell;
        }
    series_.write(cells, snapshot.time, snapshot.step);
  }



  template class GridOutput<2>;
  template class GridOutput<3>;
} // namespace talus

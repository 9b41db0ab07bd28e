// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_exchange.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/state_cells.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Mass and force of a node, as they are sent to other ranks: 1 + dim.
    template <int dim>
    constexpr unsigned int n_sent = 1 + dim;



    /// Of all nodes this rank knows, those of ghosts from their owners.
    /// Sums are right at the owners only. The cells of this rank have nodes of
    /// others at their corners, so these are asked for; once per output, where
    /// the step does not need them. Collective.
    template <int dim>
    AlignedVector<double>
    mass_and_force(const State<dim> &state)
    {
      AlignedVector<double> values(n_sent<dim> *
                                   std::size_t(state.grid.n_nodes()));
      for (unsigned int node = 0; node < state.grid.n_nodes(); ++node)
        {
          double *const        to    = &values[n_sent<dim> * std::size_t(node)];
          const Tensor<1, dim> force = state.nodes.force(node);
          to[0]                      = state.nodes.mass(node);
          for (unsigned int d = 0; d < dim; ++d)
            to[1 + d] = force[d];
        }
      NodalExchange<dim> exchange;
      exchange.prepare(state.grid, n_sent<dim>);
      exchange.copy_to_ghosts(values.data());
      return values;
    }



    /// Fields that read from @p sums (mass and force) and, for the velocity,
    /// from the nodes themselves: velocities of ghosts are there after a step.
    /// Both must outlive the fields.
    template <int dim>
    std::vector<Field>
    node_fields(const NodalFields<dim>      &nodes,
                const AlignedVector<double> &sums)
    {
      const auto add = [](const std::string &name,
                          const std::string &unit,
                          const unsigned int n,
                          const auto        &source) {
        return Field{name,
                     unit,
                     n == 1 ? FieldKind::scalar : FieldKind::vector,
                     [n, source](const unsigned int node, double *values) {
                       for (unsigned int c = 0; c < n; ++c)
                         values[c] = source(node)[c];
                     }};
      };
      const double *first = sums.data();
      return {add("mass",
                  "kg",
                  1,
                  [first](const unsigned int node) {
                    return first + n_sent<dim> * std::size_t(node);
                  }),
              add("velocity",
                  "m/s",
                  dim,
                  [&nodes](const unsigned int node) {
                    return nodes.velocity(node);
                  }),
              add("force", "N", dim, [first](const unsigned int node) {
                return first + n_sent<dim> * std::size_t(node) + 1;
              })};
    }



    /// Corners of a cell in deal.II's order, and the nodes there.
    template <int dim>
    void
    add_cell(OutputCells &cells, const Cell<dim> &cell)
    {
      for (unsigned int v = 0; v < cells.n_vertices_per_cell(); ++v)
        {
          cells.add_vertex(cell.vertex(v));
          cells.items.push_back(cell.nodes()[v]);
        }
    }
  } // namespace



  /// Cells with points only: the mesh far from the soil has nothing to show and
  /// may be most of it. Points are sorted by cell, so the segments of a cell
  /// follow each other. A corner that several cells share is written once for
  /// each: no numbering of the nodes over the ranks is needed, and ParaView
  /// does not mind.
  template <int dim>
  void
  GridOutput<dim>::observe(const State<dim> &state)
  {
    const AlignedVector<double> sums  = mass_and_force(state);
    OutputCells                 cells = state_cells(state,
                                    node_fields(state.nodes, sums),
                                    ItemsAt::vertices,
                                    box_shape<dim>);

    unsigned int previous = numbers::invalid_unsigned_int;
    for (const Segment &segment : state.points.segments())
      if (segment.cell != previous)
        {
          add_cell(cells, state.grid.cells()[segment.cell]);
          previous = segment.cell;
        }
    this->series_.write(cells);
  }



  template class GridOutput<2>;
  template class GridOutput<3>;
} // namespace talus

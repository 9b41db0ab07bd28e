// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/nodal_exchange.h>
#include <talus/observers/grid_output.h>
#include <talus/observers/state_cells.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Number of values exchanged per node: mass and force.
    template <int dim>
    constexpr unsigned int n_sent = 1 + dim;



    /// Return mass, kg, and force, N, of all nodes known to the rank, 1 + dim
    /// values per node. Sums are complete only at the owner of a node, so ghost
    /// values are imported, once per output: the step itself does not need
    /// them. Collective.
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



    /// Fields of nodes: mass and force from @p sums, velocity from @p nodes,
    /// where ghosts are valid after a step. Both arguments must outlive the
    /// fields.
    template <int dim>
    std::vector<Field>
    node_fields(const NodalFields<dim>      &nodes,
                const AlignedVector<double> &sums)
    {
      const auto sums_at = [first = sums.data()](const unsigned int node) {
        return first + n_sent<dim> * std::size_t(node);
      };
      return {scalar_field("mass",
                           "kg",
                           [=](const unsigned int node) {
                             return sums_at(node)[0];
                           }),
              vector_field<dim>("velocity",
                                "m/s",
                                [&nodes](const unsigned int node) {
                                  return nodes.velocity(node);
                                }),
              vector_field<dim>("force", "N", [=](const unsigned int node) {
                return sums_at(node) + 1;
              })};
    }



    /// Add the corners of a cell in the order of deal.II, and the nodes at the
    /// corners.
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



  /// Only cells with points are written: the mesh far from the soil has no
  /// content and may be much larger. Points are sorted by cell, so the segments
  /// of a cell follow each other. A corner shared by several cells is written
  /// once per cell: a global numbering of nodes is not needed, and ParaView
  /// accepts duplicates.
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

#include <talus/observers/grid_output.h>

#include <unordered_set>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::vector<Field>
    node_fields(const NodalFields<dim>                 &nodes,
                const std::unordered_set<unsigned int> &active)
    {
      using Sum      = NodalSum<dim>;
      const auto add = [&active](const std::string &name,
                                 const unsigned int n,
                                 const auto        &source) {
        return Field{name,
                     n == 1 ? FieldKind::scalar : FieldKind::vector,
                     n,
                     [&active, n, source](const unsigned int node,
                                          float             *values) {
                       // What inactive nodes hold is left from earlier steps.
                       const bool is_active = active.count(node) > 0;
                       for (unsigned int c = 0; c < n; ++c)
                         values[c] = is_active ? source(node)[c] : 0.;
                     }};
      };
      return {add("mass [kg]",
                  1,
                  [&nodes](const unsigned int node) {
                    return nodes.sum(node) + Sum::mass;
                  }),
              add("velocity [m/s]",
                  dim,
                  [&nodes](const unsigned int node) {
                    return nodes.motion(node) + NodalMotion<dim>::velocity;
                  }),
              add("force [N]", dim, [&nodes](const unsigned int node) {
                return nodes.sum(node) + Sum::force;
              })};
    }



    /// Corners of a cell in deal.II's order, and the nodes there.
    template <int dim>
    void
    add_cell(Patches<dim, dim> &patches, const Cell<dim> &cell)
    {
      std::array<Point<dim>, (1 << dim)>   corners;
      std::array<unsigned int, (1 << dim)> nodes;
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          unsigned int at = 0;
          corners[v]      = cell.lower;
          for (unsigned int d = 0; d < dim; ++d)
            {
              corners[v][d] += ((v >> d) & 1) * cell.size;
              at += (1 + ((v >> d) & 1)) * power(4, d);
            }
          nodes[v] = cell.patch[at];
        }
      patches.add(corners, nodes);
    }
  } // namespace



  template <int dim>
  void
  GridOutput<dim>::begin(const std::filesystem::path &folder,
                         const MPI_Comm               communicator,
                         const Beginning              beginning)
  {
    series_.begin(folder, "grid", communicator, beginning);
  }



  template <int dim>
  void
  GridOutput<dim>::list_state(StateList &list)
  {
    series_.list_state("files of grid.pvd", list);
  }



  template <int dim>
  void
  GridOutput<dim>::write(const Snapshot<dim> &snapshot)
  {
    const auto                            &list = snapshot.nodes.active_nodes();
    const std::unordered_set<unsigned int> active(list.begin(), list.end());
    Patches<dim, dim> patches(node_fields(snapshot.nodes, active));

    unsigned int previous = numbers::invalid_unsigned_int;
    for (const Segment &segment : snapshot.points.segments())
      if (segment.cell != previous)
        {
          add_cell(patches, snapshot.grid.cells()[segment.cell]);
          previous = segment.cell;
        }
    series_.write(patches, snapshot.time, snapshot.step);
  }



  template class GridOutput<2>;
  template class GridOutput<3>;
} // namespace talus

#ifndef talus_observers_output_cells_h
#define talus_observers_output_cells_h

#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// How ParaView is to read the components of a field.
  enum class FieldKind
  {
    scalar, ///< 1 component
    vector, ///< dim components, shown with 3
    tensor  ///< 9 components, row by row
  };



  /// A field of an output file: name with unit, and how to get its values.
  struct Field
  {
    std::string  name;
    FieldKind    kind;
    unsigned int n_components;
    /// Write the components at item @p i (a point, a node) to @p values.
    std::function<void(unsigned int i, float *values)> evaluate;
  };



  /// What the items of a set of cells belong to.
  enum class ItemsAt
  {
    vertices,
    cells
  };



  /// This rank's share of what one output time shows, whatever the format:
  /// vertex cells (cell_dim = 0) or quads and hexes (cell_dim = dim) that share
  /// no vertices, and the items (points, nodes) whose fields they carry.
  template <int cell_dim, int dim>
  struct OutputCells
  {
    static constexpr unsigned int n_vertices = 1 << cell_dim;

    OutputCells(const std::vector<Field> &fields, const ItemsAt items_at)
      : fields(fields)
      , items_at(items_at)
    {}

    unsigned int
    size() const
    {
      return vertices.size() / n_vertices;
    }

    /// Item at vertex @p v of cell @p c.
    unsigned int
    item(const unsigned int c, const unsigned int v) const
    {
      return items[items_at == ItemsAt::cells ? c : c * n_vertices + v];
    }

    std::vector<Field>              fields;
    ItemsAt                         items_at;
    std::vector<dealii::Point<dim>> vertices; ///< cell by cell, deal.II's order
    std::vector<unsigned int>       items;    ///< one per vertex or per cell
  };
} // namespace talus

#endif

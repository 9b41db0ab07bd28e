#ifndef talus_io_output_cells_h
#define talus_io_output_cells_h

#include <deal.II/base/point.h>

#include <array>
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



  /// Number of components in a file: vectors have three, also in 2-D.
  inline unsigned int
  n_columns(const Field &field)
  {
    return field.kind == FieldKind::scalar   ? 1
           : field.kind == FieldKind::vector ? 3
                                             : 9;
  }



  /// Values of the field at these items, n_columns() for each.
  inline std::vector<float>
  values_of(const Field &field, const std::vector<unsigned int> &items)
  {
    std::vector<float> values(items.size() * n_columns(field));
    float             *to = values.data();
    for (const unsigned int item : items)
      {
        field.evaluate(item, to);
        to += n_columns(field);
      }
    return values;
  }



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

    std::vector<Field>              fields;
    ItemsAt                         items_at;
    std::vector<dealii::Point<dim>> vertices; ///< cell by cell, deal.II's order
    std::vector<unsigned int>       items;    ///< one per vertex or per cell
  };



  /// Three coordinates for each vertex, m; z = 0 in 2-D.
  template <int cell_dim, int dim>
  std::vector<float>
  vertex_coordinates(const OutputCells<cell_dim, dim> &cells)
  {
    std::vector<float> coordinates(3 * cells.vertices.size());
    for (std::size_t v = 0; v < cells.vertices.size(); ++v)
      for (unsigned int d = 0; d < dim; ++d)
        coordinates[3 * v + d] = cells.vertices[v][d];
    return coordinates;
  }



  /// Cell by cell the numbers of its vertices, in VTK's order, if the first
  /// vertex of all has the number @p first. deal.II counts lexicographically,
  /// VTK around each quad.
  template <typename Number, int cell_dim, int dim>
  std::vector<Number>
  corners_of_cells(const OutputCells<cell_dim, dim> &cells,
                   const Number                      first = 0)
  {
    constexpr std::array<unsigned int, 8> vtk_order = {
      {0, 1, 3, 2, 4, 5, 7, 6}};
    constexpr unsigned int n = OutputCells<cell_dim, dim>::n_vertices;
    std::vector<Number>    corners(cells.vertices.size());
    for (std::size_t v = 0; v < corners.size(); ++v)
      corners[v] = first + v - v % n + vtk_order[v % n];
    return corners;
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_cells_h
#define talus_io_output_cells_h

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// How ParaView is to read the components of a field, and how many columns
  /// they take in a file.
  enum class FieldKind
  {
    scalar = 1,
    vector = 3, ///< also in 2-D
    tensor = 9  ///< row by row, also in 2-D
  };



  /// A field of an output file, and how to get its values.
  struct Field
  {
    std::string name;
    std::string unit; ///< empty if there is none to tell
    FieldKind   kind;
    /// Write the components at item @p i (a point, a node) to @p values, where
    /// zeros are.
    std::function<void(unsigned int i, float *values)> evaluate;
  };



  inline unsigned int
  n_columns(const Field &field)
  {
    return static_cast<unsigned int>(field.kind);
  }



  /// Name and unit for formats that have one text for both: "velocity [m/s]".
  inline std::string
  name_with_unit(const Field &field)
  {
    return field.unit.empty() ? field.name
                              : field.name + " [" + field.unit + "]";
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



  /// All cells of a file have the same shape.
  enum class CellShape
  {
    vertex,
    line,
    triangle,
    quad,
    hex
  };



  /// What the formats have to know of a shape.
  struct CellShapeFacts
  {
    unsigned int n_vertices;
    unsigned int vtk_type;  ///< number of VTK's cell type
    const char  *xdmf_type; ///< XDMF's TopologyType
  };



  inline const CellShapeFacts &
  facts_of(const CellShape shape)
  {
    static constexpr std::array<CellShapeFacts, 5> facts = {
      {{1, 1, "Polyvertex"},
       {2, 3, "Polyline"},
       {3, 5, "Triangle"},
       {4, 9, "Quadrilateral"},
       {8, 12, "Hexahedron"}}};
    return facts[static_cast<unsigned int>(shape)];
  }



  /// That of a cell of the mesh.
  template <int dim>
  constexpr CellShape box_shape = (dim == 2 ? CellShape::quad : CellShape::hex);



  /// This rank's share of what one output time shows, whatever the format:
  /// cells of one shape that share no vertices, and the items (points, nodes,
  /// facets) whose fields they carry.
  struct OutputCells
  {
    OutputCells(std::vector<Field>  fields,
                const ItemsAt       items_at,
                const CellShape     shape,
                const double        time,
                const unsigned long step)
      : fields(std::move(fields))
      , items_at(items_at)
      , shape(shape)
      , time(time)
      , step(step)
    {}

    template <int dim>
    void
    add_vertex(const dealii::Point<dim> &x)
    {
      for (unsigned int d = 0; d < 3; ++d)
        vertices.push_back(d < dim ? x[d] : 0.);
    }

    unsigned int
    n_vertices() const
    {
      return vertices.size() / 3;
    }

    unsigned int
    n_vertices_per_cell() const
    {
      return facts_of(shape).n_vertices;
    }

    unsigned int
    size() const
    {
      return n_vertices() / n_vertices_per_cell();
    }

    std::vector<Field> fields;
    ItemsAt            items_at;
    CellShape          shape;
    double             time; ///< s
    unsigned long      step;
    /// x, y, z of each vertex, m; z = 0 in 2-D. Cell by cell; those of quads and
    /// hexes in deal.II's order.
    std::vector<float>        vertices;
    std::vector<unsigned int> items; ///< one per vertex or per cell
  };



  /// Cell by cell the numbers of its vertices, in VTK's order, if the first
  /// vertex of all has the number @p first. deal.II counts lexicographically,
  /// VTK around each quad.
  template <typename Number>
  std::vector<Number>
  corners_of_cells(const OutputCells &cells, const Number first = 0)
  {
    constexpr std::array<unsigned int, 8> vtk_order = {
      {0, 1, 3, 2, 4, 5, 7, 6}};
    const unsigned int  n            = cells.n_vertices_per_cell();
    const bool          is_reordered = n >= 4; // quads and hexes
    std::vector<Number> corners(cells.n_vertices());
    for (std::size_t v = 0; v < corners.size(); ++v)
      corners[v] =
        first + v - v % n + (is_reordered ? vtk_order[v % n] : v % n);
    return corners;
  }
} // namespace talus

#endif

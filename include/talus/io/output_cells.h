// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_output_cells_h
#define talus_io_output_cells_h

#include <talus/base/box.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  /// Kind of a field for ParaView; the value is the number of columns in a
  /// file.
  enum class FieldKind
  {
    scalar = 1,
    vector = 3, ///< also in 2-D
    tensor = 9  ///< row by row, also in 2-D
  };



  /// Field of an output file, with a function for the values.
  struct Field
  {
    std::string name;
    std::string unit; ///< empty if there is no unit to print
    FieldKind   kind;
    /// Write the components at item @p i (a point, a node) to @p values, which
    /// are initially zero.
    std::function<void(unsigned int i, double *values)> evaluate;
    /// Whether the values are places in the mesh, like vertices.
    bool is_place = false;
  };



  inline unsigned int
  n_columns(const Field &field)
  {
    return static_cast<unsigned int>(field.kind);
  }



  /// Return name and unit for formats with a common text, "velocity [m/s]".
  inline std::string
  name_with_unit(const Field &field)
  {
    return field.unit.empty() ? field.name
                              : field.name + " [" + field.unit + "]";
  }



  /// Return the values of the field at @p items, n_columns() for each item.
  template <typename Number>
  std::vector<Number>
  values_of(const Field &field, const std::vector<unsigned int> &items)
  {
    std::vector<Number> values(items.size() * n_columns(field));
    auto                to = values.begin();
    for (const unsigned int item : items)
      {
        std::array<double, 9> components = {};
        field.evaluate(item, components.data());
        to = std::copy_n(components.begin(), n_columns(field), to);
      }
    return values;
  }



  /// Return whether single precision is too coarse for places in the mesh.
  /// Single precision has 24 bits: where the largest coordinate is 2^13 cells
  /// or more, a corner of a box would move by up to 1/2048 of a cell, and by
  /// half a metre at 5 000 km. Decided by the mesh, not by the soil: all files
  /// of a run have the same types.
  template <int dim>
  bool
  places_need_double(const Box<dim> &domain, const double cell_size)
  {
    double largest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      largest = std::max(
        {largest, std::abs(domain.lower[d]), std::abs(domain.upper[d])});
    return largest >= 8192. * cell_size;
  }



  /// Location of the items in a set of cells.
  enum class ItemsAt
  {
    vertices,
    cells
  };



  /// Common shape of all cells of a file.
  enum class CellShape
  {
    vertex,
    line,
    triangle,
    quad,
    hex
  };



  struct CellShapeFacts
  {
    unsigned int n_vertices;
    unsigned int vtk_type; ///< number of VTK's cell type
  };



  inline const CellShapeFacts &
  facts_of(const CellShape shape)
  {
    static constexpr std::array<CellShapeFacts, 5> facts = {
      {{1, 1}, {2, 3}, {3, 5}, {4, 9}, {8, 12}}};
    return facts[static_cast<unsigned int>(shape)];
  }



  /// Shape of a cell of the mesh.
  template <int dim>
  constexpr CellShape box_shape = (dim == 2 ? CellShape::quad : CellShape::hex);



  /// Content of an output time on this rank: cells of equal shape without
  /// common vertices, and the items (points, nodes, facets) with the fields of
  /// the cells.
  struct OutputCells
  {
    OutputCells(std::vector<Field>  fields,
                const ItemsAt       items_at,
                const CellShape     shape,
                const double        time,
                const unsigned long step,
                const bool          places_in_double = false)
      : fields(std::move(fields))
      , items_at(items_at)
      , shape(shape)
      , time(time)
      , step(step)
      , places_in_double(places_in_double)
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
    /// Write places in double precision. All fields without places are in
    /// single precision.
    bool places_in_double;
    /// x, y, z of each vertex, m; z = 0 in 2-D. Ordered by cell; vertices of
    /// quads and hexes are in deal.II's order.
    std::vector<double>       vertices;
    std::vector<unsigned int> items; ///< one per vertex or per cell
  };



  /// Call @p use with the coordinates of the vertices in the precision of the
  /// output, and return the result of @p use.
  template <typename Function>
  auto
  with_vertices(const OutputCells &cells, const Function &use)
  {
    if (cells.places_in_double)
      return use(cells.vertices);
    return use(
      std::vector<float>(cells.vertices.begin(), cells.vertices.end()));
  }



  /// Call @p use with the values of a field in the precision of the output, and
  /// return the result of @p use.
  template <typename Function>
  auto
  with_values(const OutputCells &cells, const Field &field, const Function &use)
  {
    if (field.is_place && cells.places_in_double)
      return use(values_of<double>(field, cells.items));
    return use(values_of<float>(field, cells.items));
  }



  /// Return the numbers of the vertices of each cell in VTK's order. deal.II
  /// counts lexicographically, VTK around each quad.
  inline std::vector<std::int32_t>
  corners_of_cells(const OutputCells &cells)
  {
    constexpr std::array<unsigned int, 8> vtk_order = {
      {0, 1, 3, 2, 4, 5, 7, 6}};
    const unsigned int        n            = cells.n_vertices_per_cell();
    const bool                is_reordered = n >= 4; // quads and hexes
    std::vector<std::int32_t> corners(cells.n_vertices());
    for (std::size_t v = 0; v < corners.size(); ++v)
      corners[v] = v - v % n + (is_reordered ? vtk_order[v % n] : v % n);
    return corners;
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/io/files.h>
#include <talus/io/vtu_writer.h>
#include <talus/observers/boxes.h>
#include <talus/observers/points_output.h>
#include <talus/observers/pore_pressure_ratio.h>
#include <talus/observers/state_cells.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Fill a 3x3 tensor from the components of a symmetric tensor, stored in
    /// the order xx, yy, zz, xy (xz, yz).
    template <int dim>
    void
    read_symmetric_tensor(const Points<dim> &points,
                          const unsigned int first,
                          const unsigned int p,
                          double            *values)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          values[3 * i + j] =
            points.data(first,
                        stress_index<dim>(std::min(i, j), std::max(i, j)))[p];
      values[8] = points.data(first, 2)[p];
    }



    /// Append the fields of a column: a single field, or a field per number of
    /// a list. The kind of the column decides, so new columns of material laws
    /// need no code here. The lambdas store the index of the column, not
    /// values; values are read when a file is written.
    template <int dim>
    void
    append_column(std::vector<Field> &fields,
                  const Points<dim>  &points,
                  const Column       &column)
    {
      const std::string  unit  = (column.unit == "-" ? "" : column.unit);
      const unsigned int first = column.first;
      const auto         add   = [&](const std::string &name,
                           const FieldKind    kind,
                           const auto        &evaluate) {
        fields.push_back({name, unit, kind, evaluate});
      };
      switch (column.kind)
        {
          case ColumnKind::scalars:
            for (unsigned int c = 0; c < column.n_components; ++c)
              add(column.n_components == 1
                    ? column.name
                    : column.name + " " + std::to_string(c),
                  FieldKind::scalar,
                  [&points, first, c](const unsigned int p, double *values) {
                    *values = points.data(first, c)[p];
                  });
            break;
          case ColumnKind::vector:
            fields.push_back(vector_field<dim>(
              column.name, unit, [&points, first](unsigned int p) {
                return load_vector(points, first, p);
              }));
            fields.back().is_place =
              first == points.position || first == points.initial_position;
            break;
          case ColumnKind::symmetric_tensor:
            add(column.name,
                FieldKind::tensor,
                [&points, first](const unsigned int p, double *values) {
                  read_symmetric_tensor(points, first, p, values);
                });
            break;
          case ColumnKind::tensor:
          case ColumnKind::deformation:
            add(column.name,
                FieldKind::tensor,
                [&points, first, kind = column.kind](const unsigned int p,
                                                     double *values) {
                  // In 2-D the out-of-plane component is 1 for a deformation
                  // gradient and 0 for any other tensor. In 3-D the loop
                  // overwrites the value.
                  values[8] = (kind == ColumnKind::deformation);
                  for (unsigned int c = 0; c < dim * dim; ++c)
                    values[3 * (c / dim) + c % dim] = points.data(first, c)[p];
                });
        }
    }



    /// Append derived vectors, needed often enough to spare users the
    /// calculator of ParaView.
    template <int dim>
    void
    append_derived_vectors(std::vector<Field> &fields, const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      fields.push_back(
        vector_field<dim>("displacement", "m", [&points](const unsigned int p) {
          return load_vector(points, points.position, p) -
                 load_vector(points, points.initial_position, p);
        }));
    }



    /// Append derived scalars. J is the volume over the initial volume. In 2-D
    /// the mean stress includes the stress out of the plane, which is not zero.
    template <int dim>
    void
    append_derived_scalars(std::vector<Field> &fields,
                           const Points<dim>  &points)
    {
      fields.push_back(
        scalar_field("speed", "m/s", [&points](const unsigned int p) {
          return load_vector(points, points.velocity, p).norm();
        }));
      fields.push_back(
        scalar_field("mean stress", "Pa", [&points](const unsigned int p) {
          return mean_normal(load_stress<dim, double>(points, p));
        }));
      fields.push_back(
        scalar_field("von Mises stress", "Pa", [&points](const unsigned int p) {
          return std::sqrt(3.) *
                 shear_stress(load_stress<dim, double>(points, p));
        }));
      fields.push_back(scalar_field("J", "", [&points](const unsigned int p) {
        return volume_of_points<dim, double>(points, p) /
               points.data(points.reference_volume)[p];
      }));
      if (points.have_pore_pressure())
        fields.push_back(
          scalar_field("pore pressure ratio",
                       "",
                       [ratio = pore_pressure_ratio(points)](
                         const unsigned int p) { return ratio[p]; }));
    }



    /// Return output cells without vertices. The items are the numbers of the
    /// points, from which fields read.
    template <int dim>
    OutputCells
    one_cell_per_point(const State<dim> &state,
                       const ItemsAt     items_at,
                       const CellShape   shape)
    {
      OutputCells cells =
        state_cells(state, point_fields(state), items_at, shape);
      cells.items.resize(state.points.size());
      std::iota(cells.items.begin(), cells.items.end(), 0);
      cells.vertices.reserve(3 * cells.items.size() *
                             cells.n_vertices_per_cell());
      return cells;
    }



    /// Create a vertex at the centre of each point, with values at vertices.
    template <int dim>
    OutputCells
    points_as_vertices(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      OutputCells        cells =
        one_cell_per_point(state, ItemsAt::vertices, CellShape::vertex);
      for (unsigned int p = 0; p < points.size(); ++p)
        cells.add_vertex(load_place(points, points.position, p));
      return cells;
    }



    /// Create a cell per point, with values at cells. Corners are in the order
    /// of deal.II, x fastest: bit d of v is the side along edge d. Neighbours
    /// share no vertices, because points drift: there are gaps and overlaps.
    template <int dim>
    OutputCells
    points_as_boxes(const State<dim> &state)
    {
      const Points<dim> &points = state.points;
      OutputCells        cells =
        one_cell_per_point(state, ItemsAt::cells, box_shape<dim>);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const Point<dim> centre = load_place(points, points.position, p);
          const auto       edges  = drawn_edges(state, p);
          for (unsigned int v = 0; v < cells.n_vertices_per_cell(); ++v)
            {
              Point<dim> corner = centre;
              for (unsigned int d = 0; d < dim; ++d)
                corner += ((v >> d) & 1 ? 0.5 : -0.5) * edges[d];
              cells.add_vertex(corner);
            }
        }
      return cells;
    }
  } // namespace



  template <int dim>
  std::vector<Field>
  point_fields(const State<dim> &state)
  {
    const Points<dim> &points = state.points;
    std::vector<Field> fields;
    for (const Column &column : points.columns())
      append_column(fields, points, column);
    append_derived_vectors(fields, state);
    append_derived_scalars(fields, points);
    return fields;
  }



  template <int dim>
  void
  PointsOutput<dim>::write(const State<dim>         &state,
                           const std::vector<Field> &further_fields)
  {
    OutputCells cells =
      (boxes_as_cells_ ? points_as_boxes(state) : points_as_vertices(state));
    cells.fields.insert(cells.fields.end(),
                        further_fields.begin(),
                        further_fields.end());
    this->series_.write(cells);
  }



  /// Used for the state after an error, without communication: vertices need
  /// only the position of a point.
  template <int dim>
  void
  write_points(const State<dim> &state, const std::filesystem::path &path)
  {
    write_file(path, [&](std::ostream &out) {
      write_vtu(out, points_as_vertices(state));
    });
  }



  template decltype(point_fields<2>) point_fields<2>;
  template decltype(point_fields<3>) point_fields<3>;
  template class PointsOutput<2>;
  template class PointsOutput<3>;
  template decltype(write_points<2>) write_points<2>;
  template decltype(write_points<3>) write_points<3>;
} // namespace talus

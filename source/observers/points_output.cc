#include <talus/io/files.h>
#include <talus/io/vtu.h>
#include <talus/observers/points_output.h>
#include <talus/points/points_kernel.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    std::string
    name_with_unit(const std::string &name, std::string unit, const int dim)
    {
      if (const auto at = unit.find("dim"); at != std::string::npos)
        unit.replace(at, 3, std::to_string(dim));
      return unit.empty() || unit == "-" ? name : name + " [" + unit + "]";
    }



    /// 3x3 tensor from the stored components of the stress.
    template <int dim>
    void
    write_stress(const Stress<dim, double> &sigma, float *values)
    {
      std::fill(values, values + 9, 0.f);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          values[3 * i + j] =
            sigma[stress_index<dim>(std::min(i, j), std::max(i, j))];
      values[8] = sigma[2];
    }



    template <int dim>
    Field
    column_field(const Points<dim> &points, const Column &column)
    {
      const unsigned int first = column.first, n = column.n_components;
      const std::string  name = name_with_unit(column.name, column.unit, dim);
      if (first == points.stress)
        return {name,
                FieldKind::tensor,
                9,
                [&points](const unsigned int p, float *values) {
                  write_stress<dim>(load_stress<dim, double>(points, p),
                                    values);
                }};
      if (n == dim * dim)
        {
          const bool is_F = (first == points.deformation_gradient);
          return {name,
                  FieldKind::tensor,
                  9,
                  [&points, first, is_F](const unsigned int p, float *values) {
                    std::fill(values, values + 9, 0.f);
                    if (is_F)
                      values[8] = 1.f;
                    for (unsigned int c = 0; c < dim * dim; ++c)
                      values[3 * (c / dim) + c % dim] =
                        points.data(first, c)[p];
                  }};
        }
      return {name,
              n == dim ? FieldKind::vector : FieldKind::scalar,
              n,
              [&points, first, n](const unsigned int p, float *values) {
                for (unsigned int c = 0; c < n; ++c)
                  values[c] = points.data(first, c)[p];
              }};
    }



    /// Mean and von Mises stress, Pa.
    template <int dim>
    std::pair<double, double>
    stress_measures(const Points<dim> &points, const unsigned int p)
    {
      const auto   sigma = load_stress<dim, double>(points, p);
      const double mean  = (sigma[0] + sigma[1] + sigma[2]) / 3.;
      double       s_s   = 0;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        s_s += (c < 3 ? (sigma[c] - mean) * (sigma[c] - mean)
                      : 2. * sigma[c] * sigma[c]);
      return {mean, std::sqrt(1.5 * s_s)};
    }



    template <int dim>
    void
    append_derived_vectors(std::vector<Field>  &fields,
                           const Snapshot<dim> &snapshot)
    {
      const Points<dim> &points = snapshot.points;
      fields.push_back({"displacement [m]",
                        FieldKind::vector,
                        dim,
                        [&points](const unsigned int p, float *values) {
                          for (unsigned int d = 0; d < dim; ++d)
                            values[d] =
                              points.data(points.position, d)[p] -
                              points.data(points.initial_position, d)[p];
                        }});
      fields.push_back({"box length [m]",
                        FieldKind::vector,
                        dim,
                        [&snapshot](const unsigned int p, float *values) {
                          const auto lengths = box_lengths(snapshot, p);
                          for (unsigned int d = 0; d < dim; ++d)
                            values[d] = lengths[d];
                        }});
    }



    template <int dim>
    void
    append_derived_scalars(std::vector<Field> &fields,
                           const Points<dim>  &points)
    {
      const auto add = [&fields](const std::string &name, const auto &value) {
        fields.push_back({name,
                          FieldKind::scalar,
                          1,
                          [value](const unsigned int p, float *values) {
                            *values = static_cast<float>(value(p));
                          }});
      };
      add("speed [m/s]", [&points](const unsigned int p) {
        Tensor<1, dim> v;
        for (unsigned int d = 0; d < dim; ++d)
          v[d] = points.data(points.velocity, d)[p];
        return v.norm();
      });
      add("mean stress [Pa]", [&points](const unsigned int p) {
        return stress_measures(points, p).first;
      });
      add("von Mises stress [Pa]", [&points](const unsigned int p) {
        return stress_measures(points, p).second;
      });
      add("J", [&points](const unsigned int p) {
        return determinant<dim>(
          load_matrix<dim, double>(points, points.deformation_gradient, p));
      });
    }



    /// No vertices yet, the points as items of the cells.
    template <int cell_dim, int dim>
    OutputCells<cell_dim, dim>
    one_cell_per_point(const Snapshot<dim> &snapshot, const ItemsAt items_at)
    {
      OutputCells<cell_dim, dim> cells(point_fields(snapshot), items_at);
      cells.items.resize(snapshot.points.size());
      std::iota(cells.items.begin(), cells.items.end(), 0);
      cells.vertices.reserve(cells.items.size() * cells.n_vertices);
      return cells;
    }



    template <int dim>
    OutputCells<0, dim>
    points_as_vertices(const Snapshot<dim> &snapshot)
    {
      const Points<dim> &points = snapshot.points;
      auto cells = one_cell_per_point<0>(snapshot, ItemsAt::vertices);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          Point<dim> x;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = points.data(points.position, d)[p];
          cells.vertices.push_back(x);
        }
      return cells;
    }



    template <int dim>
    OutputCells<dim, dim>
    points_as_boxes(const Snapshot<dim> &snapshot)
    {
      const Points<dim> &points = snapshot.points;
      auto cells = one_cell_per_point<dim>(snapshot, ItemsAt::cells);
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const Point<dim> centre = load_place(points, points.position, p);
          const auto       edges  = box_edges(snapshot, p);
          for (unsigned int v = 0; v < cells.n_vertices; ++v)
            {
              Point<dim> corner = centre;
              for (unsigned int d = 0; d < dim; ++d)
                corner += ((v >> d) & 1 ? 0.5 : -0.5) * edges[d];
              cells.vertices.push_back(corner);
            }
        }
      return cells;
    }
  } // namespace



  template <int dim>
  std::vector<Field>
  point_fields(const Snapshot<dim> &snapshot)
  {
    const Points<dim> &points = snapshot.points;
    std::vector<Field> fields;
    for (const Column &column : points.columns())
      {
        const Field field = column_field(points, column);
        if (field.kind != FieldKind::scalar || field.n_components == 1)
          {
            fields.push_back(field);
            continue;
          }
        for (unsigned int c = 0; c < column.n_components; ++c)
          {
            const unsigned int array = column.first + c;
            fields.push_back(
              {name_with_unit(column.name + " " + std::to_string(c),
                              column.unit,
                              dim),
               FieldKind::scalar,
               1,
               [&points, array](const unsigned int p, float *values) {
                 *values = points.data(array)[p];
               }});
          }
      }
    append_derived_vectors(fields, snapshot);
    append_derived_scalars(fields, points);
    return fields;
  }



  template <int dim>
  void
  PointsOutput<dim>::begin(const std::filesystem::path &folder,
                           const MPI_Comm               communicator,
                           const bool                   boxes_as_cells,
                           const FieldFormat            format,
                           const Beginning              beginning,
                           const std::string           &name)
  {
    series_.begin(folder, name, communicator, format, beginning);
    boxes_as_cells_ = boxes_as_cells;
  }



  template <int dim>
  void
  PointsOutput<dim>::list_state(StateList &list)
  {
    series_.list_state("files of points", list);
  }



  template <int dim>
  void
  PointsOutput<dim>::sync()
  {
    series_.sync();
  }



  template <int dim>
  void
  PointsOutput<dim>::write(const Snapshot<dim>      &snapshot,
                           const std::vector<Field> &further_fields)
  {
    const auto write_cells = [&](auto cells) {
      cells.fields.insert(cells.fields.end(),
                          further_fields.begin(),
                          further_fields.end());
      series_.write(cells, snapshot.time, snapshot.step);
    };
    if (boxes_as_cells_)
      write_cells(points_as_boxes(snapshot));
    else
      write_cells(points_as_vertices(snapshot));
  }



  template <int dim>
  void
  write_points(const Snapshot<dim> &snapshot, const std::filesystem::path &path)
  {
    write_file(path, [&](std::ostream &out) {
      write_vtu(out,
                points_as_vertices(snapshot),
                snapshot.time,
                snapshot.step);
    });
  }



  template std::vector<Field>
  point_fields(const Snapshot<2> &);
  template std::vector<Field>
  point_fields(const Snapshot<3> &);
  template class PointsOutput<2>;
  template class PointsOutput<3>;
  template void
  write_points(const Snapshot<2> &, const std::filesystem::path &);
  template void
  write_points(const Snapshot<3> &, const std::filesystem::path &);
} // namespace talus

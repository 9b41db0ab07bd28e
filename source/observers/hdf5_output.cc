#include <talus/observers/hdf5_output.h>
#include <talus/observers/hdf5_writer.h>

#include <algorithm>
#include <array>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// "velocity [m/s]" is "velocity" and "m/s".
    std::pair<std::string, std::string>
    name_and_unit(const std::string &name)
    {
      const auto at = name.rfind(" [");
      if (at == std::string::npos || name.back() != ']')
        return {name, "-"};
      return {name.substr(0, at), name.substr(at + 2, name.size() - at - 3)};
    }



    template <int cell_dim, int dim>
    void
    write_mesh(Hdf5Writer                       &file,
               const MPI_Comm                    communicator,
               const OutputCells<cell_dim, dim> &cells)
    {
      std::vector<float> coordinates(3 * cells.vertices.size());
      for (std::size_t v = 0; v < cells.vertices.size(); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          coordinates[3 * v + d] = cells.vertices[v][d];

      // deal.II counts lexicographically, VTK around each quad.
      constexpr std::array<unsigned int, 8> vtk_order = {
        {0, 1, 3, 2, 4, 5, 7, 6}};
      constexpr unsigned int    n = OutputCells<cell_dim, dim>::n_vertices;
      std::vector<std::int64_t> corners(cells.vertices.size());
      std::int64_t              first = 0;
      const std::int64_t        n_own = cells.vertices.size();
      MPI_Exscan(&n_own, &first, 1, MPI_INT64_T, MPI_SUM, communicator);
      for (std::size_t v = 0; v < corners.size(); ++v)
        corners[v] = first + v - v % n + vtk_order[v % n];

      const std::string type = (cell_dim == 0   ? "Polyvertex"
                                : cell_dim == 2 ? "Quadrilateral"
                                                : "Hexahedron");
      file.add_group("mesh");
      file.add_table("mesh/vertices", coordinates, 3, {{"unit", "m"}});
      file.add_table("mesh/cells", corners, n, {{"type", type}});
    }



    template <int cell_dim, int dim>
    void
    write_field(Hdf5Writer                       &file,
                const OutputCells<cell_dim, dim> &cells,
                const Field                      &field)
    {
      // Vectors have three components, also in 2-D.
      const unsigned int n_columns = (field.kind == FieldKind::scalar   ? 1
                                      : field.kind == FieldKind::vector ? 3
                                                                        : 9);
      std::vector<float> values(cells.items.size() * n_columns);
      for (std::size_t i = 0; i < cells.items.size(); ++i)
        field.evaluate(cells.items[i], values.data() + i * n_columns);

      auto [name, unit] = name_and_unit(field.name);
      // To HDF5 a slash separates groups.
      std::replace(name.begin(), name.end(), '/', '_');
      file.add_table(
        "fields/" + name,
        values,
        n_columns,
        {{"name", field.name},
         {"unit", unit},
         {"at", cells.items_at == ItemsAt::cells ? "cells" : "vertices"}});
    }
  } // namespace



  template <int cell_dim, int dim>
  void
  write_hdf5(const std::filesystem::path      &path,
             const MPI_Comm                    communicator,
             const OutputCells<cell_dim, dim> &cells,
             const double                      time,
             const unsigned long               step)
  {
    Hdf5Writer file(path, communicator);
    file.add_number("time [s]", time);
    file.add_number("step", step);
    write_mesh(file, communicator, cells);
    file.add_group("fields");
    for (const Field &field : cells.fields)
      write_field(file, cells, field);
    file.finish();
  }



#define INSTANTIATE(cell_dim, dim)                             \
  template void write_hdf5(const std::filesystem::path &,      \
                           MPI_Comm,                           \
                           const OutputCells<cell_dim, dim> &, \
                           double,                             \
                           unsigned long);

  INSTANTIATE(0, 2)
  INSTANTIATE(0, 3)
  INSTANTIATE(2, 2)
  INSTANTIATE(3, 3)
#undef INSTANTIATE
} // namespace talus

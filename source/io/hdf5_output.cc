#include <talus/io/hdf5_output.h>
#include <talus/io/hdf5_writer.h>

#include <algorithm>

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
      std::int64_t       first = 0;
      const std::int64_t n_own = cells.vertices.size();
      MPI_Exscan(&n_own, &first, 1, MPI_INT64_T, MPI_SUM, communicator);

      const std::string type = (cell_dim == 0   ? "Polyvertex"
                                : cell_dim == 2 ? "Quadrilateral"
                                                : "Hexahedron");
      file.add_group("mesh");
      file.add_table("mesh/vertices",
                     vertex_coordinates(cells),
                     3,
                     {{"unit", "m"}});
      file.add_table("mesh/cells",
                     corners_of_cells(cells, first),
                     cells.n_vertices,
                     {{"type", type}});
    }



    template <int cell_dim, int dim>
    void
    write_field(Hdf5Writer                       &file,
                const OutputCells<cell_dim, dim> &cells,
                const Field                      &field)
    {
      auto [name, unit] = name_and_unit(field.name);
      // To HDF5 a slash separates groups.
      std::replace(name.begin(), name.end(), '/', '_');
      file.add_table(
        "fields/" + name,
        values_of(field, cells.items),
        n_columns(field),
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

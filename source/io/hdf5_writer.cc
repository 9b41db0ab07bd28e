// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_errors.h>
#include <talus/io/hdf5_handle.h>
#include <talus/io/hdf5_output_file.h>
#include <talus/io/hdf5_writer.h>

#include <algorithm>
#include <iomanip>

namespace talus
{
  namespace
  {
    /// Escape the special characters of XML.
    std::string
    escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += (c == '&'   ? "&amp;"
                   : c == '<' ? "&lt;"
                   : c == '>' ? "&gt;"
                   : c == '"' ? "&quot;"
                              : std::string(1, c));
      return result;
    }



    /// Writes datasets, and collects the description for the index.
    class FileWithDescription
    {
    public:
      /// Atomic, since ParaView may read the folder during the run. No
      /// checksums: a run does not resume from output files.
      FileWithDescription(const std::filesystem::path &path,
                          const MPI_Comm               communicator)
        : file(path,
               communicator,
               {/*has_checksums=*/false,
                /*is_compressed=*/true,
                /*is_atomic=*/true})
      {}

      /// Write a dataset and return XDMF's reference to the dataset.
      template <typename Number>
      std::string
      write(const std::string         &name,
            const std::vector<Number> &rows,
            const unsigned int         n_columns)
      {
        file.write(name, rows, n_columns);
        std::string extent =
          std::to_string(file.first_and_total(rows.size() / n_columns).second);
        if (n_columns > 1)
          extent += " " + std::to_string(n_columns);
        const bool is_real = std::is_floating_point_v<Number>;
        return text("          <DataItem Dimensions=\"",
                    extent,
                    "\" NumberType=\"",
                    is_real ? "Float" : "Int",
                    "\" Precision=\"",
                    sizeof(Number),
                    "\" Format=\"HDF\">",
                    escaped(file.path().filename().string() + ":/" + name),
                    "</DataItem>\n");
      }

      /// Write the cells. The vertices of this rank are numbered after the
      /// vertices of lower ranks. No vertex is shared, and no agreement on a
      /// numbering is needed.
      void
      write_mesh(const OutputCells &cells)
      {
        const std::string type    = facts_of(cells.shape).xdmf_type;
        const auto [first, total] = file.first_and_total(cells.n_vertices());
        const unsigned int n      = cells.n_vertices_per_cell();
        file.create_group("mesh");
        const std::string vertices =
          with_vertices(cells, [&](const auto &coordinates) {
            return write("mesh/vertices", coordinates, 3);
          });
        file.set_attribute("mesh/vertices", "unit", std::string("m"));
        const std::string corners =
          write("mesh/cells", corners_of_cells<std::int64_t>(cells, first), n);
        file.set_attribute("mesh/cells", "type", type);
        description += text("        <Topology TopologyType=\"",
                            type,
                            "\" NumberOfElements=\"",
                            total / n,
                            "\" NodesPerElement=\"",
                            n,
                            "\">\n",
                            corners,
                            "        </Topology>\n"
                            "        <Geometry GeometryType=\"XYZ\">\n",
                            vertices,
                            "        </Geometry>\n");
      }

      /// Write a field. The rows of this rank follow the rows of lower ranks,
      /// as in all datasets: row i is the same point in each.
      void
      write_field(const OutputCells &cells, const Field &field)
      {
        const bool at_cells = (cells.items_at == ItemsAt::cells);
        // For HDF5 a slash separates groups.
        std::string name = field.name;
        std::replace(name.begin(), name.end(), '/', '_');
        name = "fields/" + name;
        const std::string item =
          with_values(cells, field, [&](const auto &values) {
            return write(name, values, n_columns(field));
          });
        file.set_attribute(name, "name", name_with_unit(field));
        file.set_attribute(name, "unit", field.unit.empty() ? "-" : field.unit);
        file.set_attribute(name,
                           "at",
                           std::string(at_cells ? "cells" : "vertices"));
        description += text("        <Attribute Name=\"",
                            escaped(name_with_unit(field)),
                            "\" AttributeType=\"",
                            field.kind == FieldKind::scalar   ? "Scalar"
                            : field.kind == FieldKind::vector ? "Vector"
                                                              : "Tensor",
                            "\" Center=\"",
                            at_cells ? "Cell" : "Node",
                            "\">\n",
                            item,
                            "        </Attribute>\n");
      }

      Hdf5OutputFile file;
      std::string    description;
    };
  } // namespace



  /// The file is on the disk when close() returns; nothing remains to be
  /// synced.
  IndexEntry
  Hdf5Writer::write(const std::filesystem::path &folder,
                    const std::string           &base,
                    const MPI_Comm               communicator,
                    const OutputCells           &cells,
                    std::vector<std::filesystem::path> &) const
  {
    FileWithDescription writer(folder / (base + ".h5"), communicator);
    Hdf5OutputFile     &file = writer.file;
    file.set_attribute("/", "time [s]", cells.time);
    file.set_attribute("/", "step", static_cast<double>(cells.step));
    writer.write_mesh(cells);
    file.create_group("fields");
    for (const Field &field : cells.fields)
      writer.write_field(cells, field);
    file.close();
    AssertThrow(file.error().empty(),
                ExcUser(failed_write(file.path(), file.error())));
    return {cells.time, base + ".h5", writer.description};
  }



  /// The library knows the expected length from the header of a file.
  bool
  Hdf5Writer::is_complete(const std::filesystem::path &path) const
  {
    const Hdf5Errors not_printed;
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT),
                          H5Fclose);
    return file.is_valid();
  }



  /// Only light data, in XML; values are in the HDF5 files named there. Files
  /// that the user has moved away are left out of the index.
  std::filesystem::path
  Hdf5Writer::write_index(const std::filesystem::path   &folder,
                          const std::string             &name,
                          const std::vector<IndexEntry> &entries) const
  {
    const std::filesystem::path path = folder / index_name(name);
    write_file(path, [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n"
             "<Xdmf Version=\"2.0\">\n"
             "  <Domain>\n"
             "    <Grid Name=\"series\" GridType=\"Collection\" "
             "CollectionType=\"Temporal\">\n"
          << std::setprecision(16);
      for (const IndexEntry &entry : entries)
        if (std::filesystem::exists(folder / entry.file))
          out << "      <Grid Name=\"cells\" GridType=\"Uniform\">\n"
                 "        <Time Value=\""
              << entry.time << "\"/>\n"
              << entry.description << "      </Grid>\n";
      out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
    });
    return path;
  }
} // namespace talus

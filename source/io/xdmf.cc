#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_tables.h>
#include <talus/io/xdmf.h>

#include <iomanip>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// As XML wants it.
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



    /// A reference to a dataset.
    std::string
    data_item(const std::string &file,
              const Hdf5Table   &table,
              const std::string &type)
    {
      std::string extent = std::to_string(table.n_rows);
      if (table.n_columns > 1)
        extent += " " + std::to_string(table.n_columns);
      return text("          <DataItem Dimensions=\"",
                  extent,
                  "\" ",
                  type,
                  " Format=\"HDF\">",
                  escaped(file + ":" + table.path),
                  "</DataItem>\n");
    }



    std::string
    attribute(const std::string &file, const Hdf5Table &table)
    {
      const std::string kind     = (table.n_columns == 1   ? "Scalar"
                                    : table.n_columns == 3 ? "Vector"
                                                           : "Tensor");
      const bool        at_cells = (table.attributes.at("at") == "cells");
      return text("        <Attribute Name=\"",
                  escaped(table.attributes.at("name")),
                  "\" AttributeType=\"",
                  kind,
                  "\" Center=\"",
                  at_cells ? "Cell" : "Node",
                  "\">\n",
                  data_item(file,
                            table,
                            "NumberType=\"Float\" Precision=\"4\""),
                  "        </Attribute>\n");
    }



    /// The cells and fields of one file.
    std::string
    describe(const std::filesystem::path &folder, const std::string &name)
    {
      std::ostringstream out;
      for (const Hdf5Table &table : list_tables(folder / name, "mesh"))
        if (table.path == "/mesh/cells")
          out << "        <Topology TopologyType=\""
              << table.attributes.at("type") << "\" NumberOfElements=\""
              << table.n_rows << "\" NodesPerElement=\"" << table.n_columns
              << "\">\n"
              << data_item(name, table, "NumberType=\"Int\" Precision=\"8\"")
              << "        </Topology>\n";
        else
          out << "        <Geometry GeometryType=\"XYZ\">\n"
              << data_item(name, table, "NumberType=\"Float\" Precision=\"4\"")
              << "        </Geometry>\n";
      for (const Hdf5Table &table : list_tables(folder / name, "fields"))
        out << attribute(name, table);
      return out.str();
    }
  } // namespace



  void
  XdmfIndex::write(
    const std::filesystem::path                       &path,
    const std::vector<std::pair<double, std::string>> &times_and_names)
  {
    const std::filesystem::path folder = path.parent_path();
    write_file(path, [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n"
             "<Xdmf Version=\"2.0\">\n"
             "  <Domain>\n"
             "    <Grid Name=\"series\" GridType=\"Collection\" "
             "CollectionType=\"Temporal\">\n"
          << std::setprecision(16);
      for (const auto &[time, name] : times_and_names)
        {
          if (!std::filesystem::exists(folder / name))
            continue;
          std::string &grid = grids_[name];
          if (grid.empty())
            grid = describe(folder, name);
          out << "      <Grid Name=\"cells\" GridType=\"Uniform\">\n"
                 "        <Time Value=\""
              << time << "\"/>\n"
              << grid << "      </Grid>\n";
        }
      out << "    </Grid>\n  </Domain>\n</Xdmf>\n";
    });
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/vtu_arrays.h>
#include <talus/io/vtu_writer.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
#ifdef DEAL_II_WORDS_BIGENDIAN
    const std::string byte_order = "BigEndian";
#else
    const std::string byte_order = "LittleEndian";
#endif

    /// Write an element DataArray with @p attributes.
    template <typename Number>
    void
    write_array(std::ostream              &out,
                const std::string         &attributes,
                const std::vector<Number> &values)
    {
      out << "<DataArray " << attributes << " format=\"binary\">\n";
      write_vtu_array(out, values);
      out << "\n</DataArray>\n";
    }



    /// Return the number type of the vertices.
    std::string
    type_of_places(const OutputCells &cells)
    {
      return cells.places_in_double ? "Float64" : "Float32";
    }



    /// Return type, name and number of components of a field.
    std::string
    attributes_of(const OutputCells &cells, const Field &field)
    {
      return text("type=\"",
                  field.is_place ? type_of_places(cells) : "Float32",
                  "\" Name=\"",
                  name_with_unit(field),
                  "\" NumberOfComponents=\"",
                  n_columns(field),
                  "\"");
    }



    /// Write vertices and cells. Vertices are ordered by cell: the corners of
    /// cell c begin at c times the number of corners, in the order of
    /// corners_of_cells().
    void
    write_geometry(std::ostream &out, const OutputCells &cells)
    {
      const std::uint8_t        type = facts_of(cells.shape).vtk_type;
      std::vector<std::int32_t> offsets(cells.size());
      for (unsigned int c = 0; c < cells.size(); ++c)
        offsets[c] = (c + 1) * cells.n_vertices_per_cell();

      out << "<Points>\n";
      with_vertices(cells, [&](const auto &vertices) {
        write_array(out,
                    "type=\"" + type_of_places(cells) +
                      "\" NumberOfComponents=\"3\"",
                    vertices);
      });
      out << "</Points>\n<Cells>\n";
      write_array(out,
                  "type=\"Int32\" Name=\"connectivity\"",
                  corners_of_cells<std::int32_t>(cells));
      write_array(out, "type=\"Int32\" Name=\"offsets\"", offsets);
      write_array(out,
                  "type=\"UInt8\" Name=\"types\"",
                  std::vector<std::uint8_t>(cells.size(), type));
      out << "</Cells>\n";
    }



    /// Return the kind of data for ParaView.
    std::string
    data_of(const OutputCells &cells)
    {
      return cells.items_at == ItemsAt::cells ? "CellData" : "PointData";
    }



    /// Write the file that lists the files of all ranks.
    void
    write_pvtu(std::ostream                   &out,
               const OutputCells              &cells,
               const std::vector<std::string> &pieces)
    {
      // All ranks have the same fields as the first rank; no message is needed.
      const std::string data = data_of(cells);
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\" "
             "byte_order=\""
          << byte_order
          << "\">\n"
             "<PUnstructuredGrid GhostLevel=\"0\">\n"
             "<PPoints>\n"
             "<PDataArray type=\""
          << type_of_places(cells)
          << "\" NumberOfComponents=\"3\"/>\n"
             "</PPoints>\n"
             "<P"
          << data << ">\n";
      for (const Field &field : cells.fields)
        out << "<PDataArray " << attributes_of(cells, field) << "/>\n";
      out << "</P" << data << ">\n";
      for (const std::string &piece : pieces)
        out << "<Piece Source=\"" << piece << "\"/>\n";
      out << "</PUnstructuredGrid>\n</VTKFile>\n";
    }
  } // namespace



  /// VTK's readers know the names TIME and CYCLE.
  void
  write_vtu(std::ostream &out, const OutputCells &cells)
  {
    const std::string data = data_of(cells);
    out << "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\""
        << byte_order
        << "\" compressor=\"vtkZLibDataCompressor\">\n"
           "<UnstructuredGrid>\n"
           "<FieldData>\n"
           "<DataArray type=\"Float64\" Name=\"TIME\" NumberOfTuples=\"1\" "
           "format=\"ascii\">"
        << std::setprecision(16) << cells.time
        << "</DataArray>\n"
           "<DataArray type=\"Int64\" Name=\"CYCLE\" NumberOfTuples=\"1\" "
           "format=\"ascii\">"
        << cells.step << "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\""
        << cells.n_vertices() << "\" NumberOfCells=\"" << cells.size()
        << "\">\n";
    write_geometry(out, cells);
    out << '<' << data << ">\n";
    for (const Field &field : cells.fields)
      with_values(cells, field, [&](const auto &values) {
        write_array(out, attributes_of(cells, field), values);
      });
    out << "</" << data << ">\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  }



  /// A file per rank; the only message tells which ranks write. (HDF5 makes a
  /// common file.) write_file() makes each file complete or not at all.
  IndexEntry
  VtuWriter::write(const std::filesystem::path        &folder,
                   const std::string                  &base,
                   const MPI_Comm                      communicator,
                   const OutputCells                  &cells,
                   std::vector<std::filesystem::path> &unsynced) const
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const auto         piece   = [&](const unsigned int r) {
      return base + (n_ranks > 1 ? "." + std::to_string(r) : "") + ".vtu";
    };
    const auto write = [&](const std::string &name, const auto &content) {
      write_file(folder / name, content);
      unsynced.push_back(folder / name);
    };

    // ParaView has no use for files without cells: only ranks with cells write
    // a file, or the first rank if there are no cells.
    const auto n_cells = Utilities::MPI::all_gather(communicator, cells.size());
    const bool nobody  = std::all_of(n_cells.begin(),
                                    n_cells.end(),
                                    [](const auto n) { return n == 0; });
    const auto writes  = [&](const unsigned int r) {
      return n_cells[r] > 0 || (nobody && r == 0);
    };
    // Nothing is written twice: each rank has the cells of the points on the
    // rank.
    if (writes(rank))
      write(piece(rank), [&](std::ostream &out) { write_vtu(out, cells); });
    if (n_ranks == 1)
      return {cells.time, piece(0), ""};

    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (writes(r))
        pieces.push_back(piece(r));
    if (rank == 0)
      write(base + ".pvtu",
            [&](std::ostream &out) { write_pvtu(out, cells, pieces); });
    return {cells.time, base + ".pvtu", ""};
  }



  /// Reads the names of the parts from the file of write_pvtu(): ranks without
  /// cells have no part.
  std::vector<std::string>
  VtuWriter::files_of(const std::filesystem::path &folder,
                      const IndexEntry            &entry) const
  {
    std::vector<std::string> files = {entry.file};
    std::ifstream            pvtu;
    if (std::filesystem::path(entry.file).extension() == ".pvtu")
      pvtu.open(folder / entry.file);
    const std::string begin = "<Piece Source=\"";
    for (std::string line; std::getline(pvtu, line);)
      if (line.rfind(begin, 0) == 0)
        files.push_back(
          line.substr(begin.size(),
                      line.find('"', begin.size()) - begin.size()));
    return files;
  }



  /// Looks for the closing tag at the end.
  bool
  VtuWriter::is_complete(const std::filesystem::path &path) const
  {
    const std::string end = "</VTKFile>\n";
    std::string       found(end.size(), ' ');
    std::ifstream     file(path, std::ios::binary);
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    file.read(found.data(), found.size());
    return file && found == end;
  }



  // deal.II's function for the index writes the date into the file and keeps
  // only 12 digits of the times.
  std::filesystem::path
  VtuWriter::write_index(const std::filesystem::path   &folder,
                         const std::string             &name,
                         const std::vector<IndexEntry> &entries) const
  {
    const std::filesystem::path path = folder / index_name(name);
    write_file(path, [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"Collection\" version=\"0.1\">\n"
             "  <Collection>\n"
          << std::setprecision(16);
      for (const IndexEntry &entry : entries)
        out << "    <DataSet timestep=\"" << entry.time
            << "\" group=\"\" part=\"0\" file=\"" << entry.file << "\"/>\n";
      out << "  </Collection>\n</VTKFile>\n";
    });
    return path;
  }
} // namespace talus

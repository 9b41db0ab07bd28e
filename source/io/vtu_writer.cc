// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/vtu_writer.h>

#include <zlib.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    using Bytes = std::vector<unsigned char>;

    /// Compress bytes with zlib at @p level; level 0 only wraps.
    Bytes
    pack(const unsigned char *bytes, const std::size_t n, const int level)
    {
      uLongf    size = compressBound(n);
      Bytes     packed(size);
      const int error = compress2(packed.data(), &size, bytes, n, level);
      AssertThrow(error == Z_OK, ExcInternalError());
      packed.resize(size);
      return packed;
    }



    /// Return the level for zlib. Most computed numbers look like noise to
    /// zlib: compression would take most of the time of an output and save a
    /// tenth. Noise is only wrapped. A sample from the middle of the array
    /// decides.
    int
    level_for(const unsigned char *bytes, const std::size_t n)
    {
      constexpr std::size_t n_sample = 4096;
      if (n < 2 * n_sample)
        return Z_BEST_SPEED;
      const Bytes sample = pack(bytes + n / 2, n_sample, Z_BEST_SPEED);
      return sample.size() <= n_sample / 2 ? Z_BEST_SPEED : Z_NO_COMPRESSION;
    }
  } // namespace



  // Own conversion: deal.II's takes as long as the compression, and makes
  // copies. Three bytes become four digits; the last group is filled up with
  // '='. Digits go through a buffer, since a call of the stream per digit would
  // take longer than the conversion.
  void
  write_base64(std::ostream        &out,
               const unsigned char *bytes,
               const std::size_t    n)
  {
    constexpr char          digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                       "abcdefghijklmnopqrstuvwxyz0123456789+/";
    std::array<char, 16384> buffer; // a multiple of 4
    std::size_t             size = 0;
    for (std::size_t i = 0; i < n; i += 3)
      {
        const unsigned int n_here = (n - i < 3 ? n - i : 3);
        std::uint32_t      bits   = bytes[i] << 16;
        if (n_here > 1)
          bits |= bytes[i + 1] << 8;
        if (n_here > 2)
          bits |= bytes[i + 2];
        for (unsigned int digit = 0; digit < 4; ++digit)
          buffer[size++] =
            (digit <= n_here ? digits[(bits >> (18 - 6 * digit)) & 63] : '=');
        if (size == buffer.size())
          {
            out.write(buffer.data(), size);
            size = 0;
          }
      }
    out.write(buffer.data(), size);
  }



  /// VTK's format "binary" with a compressor: a header of four 32-bit numbers
  /// (blocks, size of a block, size of the last block, compressed size), then
  /// the data, header and data each in base64. A single block needs no list of
  /// sizes.
  template <typename Number>
  void
  write_vtu_array(std::ostream &out, const std::vector<Number> &values)
  {
    const std::size_t size = values.size() * sizeof(Number);
    AssertThrow(size <= std::numeric_limits<std::uint32_t>::max(),
                ExcUser("An array of a VTU file is larger than 4 GB. Use "
                        "more ranks."));
    const auto *bytes  = reinterpret_cast<const unsigned char *>(values.data());
    const Bytes packed = pack(bytes, size, level_for(bytes, size));

    const std::array<std::uint32_t, 4> header = {
      {1,
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(size),
       static_cast<std::uint32_t>(packed.size())}};
    write_base64(out,
                 reinterpret_cast<const unsigned char *>(header.data()),
                 sizeof(header));
    write_base64(out, packed.data(), packed.size());
  }



  template decltype(write_vtu_array<double>) write_vtu_array<double>;
  template decltype(write_vtu_array<float>)  write_vtu_array<float>;
  template decltype(write_vtu_array<std::int32_t>)
    write_vtu_array<std::int32_t>;
  template decltype(write_vtu_array<std::uint8_t>)
    write_vtu_array<std::uint8_t>;



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
                  corners_of_cells(cells));
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



    /// VTK's readers know the names TIME and CYCLE.
    void
    write_begin(std::ostream &out, const OutputCells &cells)
    {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\""
          << byte_order
          << "\" compressor=\"vtkZLibDataCompressor\">\n"
             "<UnstructuredGrid>\n"
             "<FieldData>\n"
             "<DataArray type=\"Float64\" Name=\"TIME\" NumberOfTuples=\"1\" "
             "format=\"ascii\">"
          << csv_field(cells.time)
          << "</DataArray>\n"
             "<DataArray type=\"Int64\" Name=\"CYCLE\" NumberOfTuples=\"1\" "
             "format=\"ascii\">"
          << cells.step << "</DataArray>\n</FieldData>\n";
    }



    /// Write the cells of this rank.
    void
    write_piece(std::ostream &out, const OutputCells &cells)
    {
      const std::string data = data_of(cells);
      out << "<Piece NumberOfPoints=\"" << cells.n_vertices()
          << "\" NumberOfCells=\"" << cells.size() << "\">\n";
      write_geometry(out, cells);
      out << '<' << data << ">\n";
      for (const Field &field : cells.fields)
        with_values(cells, field, [&](const auto &values) {
          write_array(out, attributes_of(cells, field), values);
        });
      out << "</" << data << ">\n</Piece>\n";
    }



    const std::string end = "</UnstructuredGrid>\n</VTKFile>\n";



    /// Write the pieces that the higher ranks send, one after the other: the
    /// memory of the first rank holds one of them.
    void
    write_pieces_of_others(std::ostream &out, const MPI_Comm communicator)
    {
      const int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      for (int rank = 1; rank < n_ranks; ++rank)
        {
          MPI_Status status;
          int        size;
          MPI_Probe(rank, 0, communicator, &status);
          MPI_Get_count(&status, MPI_CHAR, &size);
          std::string piece(size, ' ');
          MPI_Recv(piece.data(),
                   size,
                   MPI_CHAR,
                   rank,
                   0,
                   communicator,
                   MPI_STATUS_IGNORE);
          out << piece;
        }
    }
  } // namespace



  void
  write_vtu(std::ostream &out, const OutputCells &cells)
  {
    write_begin(out, cells);
    write_piece(out, cells);
    out << end;
  }



  /// ParaView has no use for pieces without cells: only ranks with cells have a
  /// piece, or the first rank if there are no cells. Nothing is written twice:
  /// each rank has the cells of the points on the rank.
  void
  write_vtu(const std::filesystem::path &path,
            const MPI_Comm               communicator,
            const OutputCells           &cells)
  {
    const auto n_cells  = Utilities::MPI::sum(cells.size(), communicator);
    const bool is_first = is_first_rank(communicator);
    std::ostringstream own;
    if (cells.size() > 0 || (n_cells == 0 && is_first))
      write_piece(own, cells);
    const std::string piece = own.str();
    if (is_first)
      write_file(path, [&](std::ostream &out) {
        write_begin(out, cells);
        out << piece;
        write_pieces_of_others(out, communicator);
        out << end;
      });
    else
      {
        AssertThrow(piece.size() <= std::numeric_limits<int>::max(),
                    ExcUser("The cells of a rank take more than 2 GB in a VTU "
                            "file. Use more ranks."));
        MPI_Send(piece.data(), piece.size(), MPI_CHAR, 0, 0, communicator);
      }
  }



  /// Looks for the closing tag at the end.
  bool
  is_complete_vtu(const std::filesystem::path &path)
  {
    std::string   found(end.size(), ' ');
    std::ifstream file(path, std::ios::binary);
    file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
    file.read(found.data(), found.size());
    return file && found == end;
  }
} // namespace talus

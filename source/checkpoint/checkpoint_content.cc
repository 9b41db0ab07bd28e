// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_content.h>
#include <talus/io/checksum.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Name of the reduction, for readers of the file without talus.
    const char *
    name_of(const Reduction reduction)
    {
      switch (reduction)
        {
          case Reduction::sum:
            return "sum";
          case Reduction::maximum:
            return "maximum";
          default:
            return "equal";
        }
    }



    /// Return @p name; a slash would create a group in HDF5.
    std::string
    checked(const std::string &name)
    {
      AssertThrow(name.find('/') == std::string::npos,
                  ExcInternalError("'" + name + "' must not have a slash."));
      return name;
    }



    /// Load a column. The file stores the components of a point side by side,
    /// as expected by h5py; Points has a row per component. The number of rows
    /// and columns is taken from the file, so that differences between versions
    /// are detected. @p first is the first row of this rank. Collective.
    template <int dim>
    void
    load_column(Hdf5InputFile      &file,
                const Column       &column,
                const std::uint64_t first,
                Points<dim>        &points)
    {
      const unsigned int        n    = column.n_components;
      const std::string         name = "points/" + column.name;
      const std::vector<double> rows = file.read(name, first, points.size());
      /// The error of HDF5 becomes part of the message.
      check_read(file);
      AssertThrow(file.shape(name).second == n,
                  ExcUser("In '" + file.path().string() + "' the column '" +
                          column.name +
                          "' has a different number of components from this "
                          "version of talus. Resume with the version of talus "
                          "that wrote the file."));
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int p = 0; p < points.size(); ++p)
          points.data(column.first, c)[p] = rows[std::size_t(n) * p + c];
    }
  } // namespace



  /// Attributes of the file: h5dump shows attributes without reading arrays.
  void
  save_head(Hdf5OutputFile &file, const CheckpointHead &head)
  {
    file.set_attribute("/", "format version", head.format);
    file.set_attribute("/", "dimension", head.dimension);
    file.set_attribute("/", "ranks", head.n_ranks);
    file.set_attribute("/", "step", head.step);
    file.set_attribute("/", "time [s]", head.time);
    file.set_attribute("/", "end time [s]", head.end_time);
    file.set_attribute("/", "talus version", head.version);
    file.set_attribute("/", "git revision", head.revision);
  }



  /// The format is read first: other formats may lack the other entries.
  CheckpointHead
  load_head(Hdf5InputFile &file)
  {
    CheckpointHead head;
    head.format = file.integer_attribute("/", "format version");
    if (head.format != checkpoint_format)
      return head;
    head.dimension = file.integer_attribute("/", "dimension");
    head.n_ranks   = file.integer_attribute("/", "ranks");
    head.step      = file.integer_attribute("/", "step");
    head.time      = file.number_attribute("/", "time [s]");
    head.end_time  = file.number_attribute("/", "end time [s]");
    head.version   = file.text_attribute("/", "talus version");
    head.revision  = file.text_attribute("/", "git revision");
    return head;
  }



  /// Columns are saved by name in the order of the cells, independent of the
  /// owners: another number of ranks reads the same rows in other portions. The
  /// number of points per cell is saved, so that loading needs no search, and
  /// the order within a cell, on which sums depend, is restored. Collective.
  template <int dim>
  void
  save_points(Hdf5OutputFile            &file,
              const Points<dim>         &points,
              const std::vector<double> &cell_weights)
  {
    std::vector<double> points_of_cell(cell_weights.size(), 0.);
    for (const Segment &segment : points.segments())
      points_of_cell[segment.cell] += segment.end - segment.begin;
    file.create_group("cells");
    file.write("cells/points", points_of_cell, 1);
    file.write("cells/weight", cell_weights, 1);

    file.create_group("points");
    // One column at a time: the extra memory is that of the largest column.
    std::vector<double> rows;
    for (const Column &column : points.columns())
      {
        const unsigned int n = column.n_components;
        rows.resize(std::size_t(n) * points.size());
        for (unsigned int c = 0; c < n; ++c)
          for (unsigned int p = 0; p < points.size(); ++p)
            rows[std::size_t(n) * p + c] = points.data(column.first, c)[p];
        const std::string name = "points/" + checked(column.name);
        file.write(name, rows, n);
        file.set_attribute(name, "unit", column.unit);
      }
  }



  /// The partition is part of the state: it determines the order of sums over
  /// ranks.
  std::vector<double>
  load_cell_weights(Hdf5InputFile &file, const unsigned int n_cells)
  {
    return file.read("cells/weight",
                     file.first_and_total(n_cells).first,
                     n_cells);
  }



  /// The cells of a rank follow the cells of lower ranks, in the file as along
  /// the curve of p4est; rows of points follow from the numbers of points per
  /// cell. A missing or additional column would be lost or invented state: both
  /// are errors. Collective.
  template <int dim>
  std::vector<unsigned int>
  load_points(Hdf5InputFile     &file,
              const unsigned int n_cells,
              Points<dim>       &points)
  {
    const std::vector<double> points_of_cell =
      file.read("cells/points", file.first_and_total(n_cells).first, n_cells);
    check_read(file);
    AssertThrow(file.shape("cells/points").first ==
                  file.first_and_total(n_cells).second,
                ExcUser("The checkpoint file '" + file.path().string() +
                        "' has a different number of cells from its mesh. "
                        "Remove the checkpoint, so that the previous one is "
                        "used."));
    const double n_points =
      std::accumulate(points_of_cell.begin(), points_of_cell.end(), 0.);
    points.append(static_cast<unsigned int>(n_points));

    AssertThrow(file.names("points").size() == points.columns().size(),
                ExcUser("In '" + file.path().string() +
                        "' the points have different columns from this version "
                        "of talus. Resume with the version of talus that wrote "
                        "the file."));
    const std::uint64_t first = file.first_and_total(points.size()).first;
    for (const Column &column : points.columns())
      load_column(file, column, first, points);

    std::vector<unsigned int> cells;
    for (unsigned int c = 0; c < n_cells; ++c)
      cells.insert(cells.end(), points_of_cell[c], c);
    return cells;
  }



  namespace
  {
    constexpr const char *name_of_numbers = "state/numbers";
    constexpr const char *name_of_columns = "text/columns of the state";
  } // namespace



  /// The value of each rank is saved, not the sum: with the same number of
  /// ranks every rank gets its own value back with identical round-off. All
  /// numbers are in one array with a column per number, because the time of
  /// HDF5 grows with the square of the number of arrays in a group. Collective.
  void
  save_state(Hdf5OutputFile &file, const StateList &list)
  {
    std::vector<double> own;
    std::string         columns;
    for (const StateList::Number &number : list.numbers())
      {
        own.push_back(number.get());
        columns += text(number.name,
                        '\t',
                        number.unit,
                        '\t',
                        name_of(number.reduction),
                        '\n');
      }
    file.create_group("state");
    file.write(name_of_numbers, own, own.size());
    file.create_group("text");
    file.write_text(name_of_columns, columns);
    for (const StateList::Text &text : list.texts())
      file.write_text("text/" + checked(text.name), text.get());
    for (const StateList::Table &table : list.tables())
      {
        if (&table == &list.tables().front())
          file.create_group("tables");
        const std::string name = "tables/" + checked(table.name);
        const bool        is_saved =
          !table.is_common || is_first_rank(file.communicator());
        file.write(name,
                   is_saved ? table.get() : std::vector<double>(),
                   table.n_columns);
        file.set_attribute(name, "columns", table.columns);
      }
  }



  /// restored_share() computes the values for another number of ranks: sums and
  /// maxima of the whole run are unchanged. Collective.
  void
  load_state(Hdf5InputFile &file, const StateList &list)
  {
    const MPI_Comm      communicator = file.communicator();
    const unsigned int  n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int  rank = Utilities::MPI::this_mpi_process(communicator);
    const std::uint64_t n_ranks_then = file.integer_attribute("/", "ranks");
    const std::vector<double> values =
      file.read(name_of_numbers, 0, n_ranks_then);
    std::istringstream lines(file.read_text(name_of_columns));
    check_read(file);
    std::map<std::string, std::size_t> columns; // by name of the number
    for (std::string line; std::getline(lines, line);)
      columns.emplace(line.substr(0, line.find('\t')), columns.size());
    for (const StateList::Number &number : list.numbers())
      {
        const auto column = columns.find(number.name);
        AssertThrow(column != columns.end() &&
                      values.size() == n_ranks_then * columns.size(),
                    ExcUser("In '" + file.path().string() + "' the number '" +
                            number.name +
                            "' is missing, which this version of talus needs. "
                            "Resume with the version of talus that wrote the "
                            "file."));
        std::vector<double> shares;
        for (std::size_t i = column->second; i < values.size();
             i += columns.size())
          shares.push_back(values[i]);
        number.set(restored_share(shares, number.reduction, rank, n_ranks));
      }
    for (const StateList::Text &text : list.texts())
      {
        const std::string value = file.read_text("text/" + text.name);
        check_read(file);
        text.set(value);
      }
    for (const StateList::Table &table : list.tables())
      {
        const std::string         name  = "tables/" + table.name;
        const auto                shape = file.shape(name);
        const std::vector<double> rows  = file.read(name, 0, shape.first);
        check_read(file);
        AssertThrow(shape.second == table.n_columns,
                    ExcUser("In '" + file.path().string() + "' the table '" +
                            table.name +
                            "' has a different number of columns from this "
                            "version of talus. Resume with the version of "
                            "talus that wrote the file."));
        table.set(rows);
      }
  }



  bool
  is_mesh_file(const std::string &name)
  {
    static const std::set<std::string> endings = {
      "", ".info", "_fixed.data", "_variable.data", "_triangulation.data"};
    const std::string mesh = mesh_file_name;
    return name.compare(0, mesh.size(), mesh) == 0 &&
           endings.count(name.substr(mesh.size())) == 1;
  }



  /// Names are sorted, since the order of directory entries is undefined. Other
  /// files in the folder are ignored: notes of the user, remains of open files
  /// removed on a network file system.
  std::string
  mesh_checksums(const std::filesystem::path &checkpoint)
  {
    std::vector<std::filesystem::path> paths;
    for (const auto &entry : std::filesystem::directory_iterator(checkpoint))
      if (is_mesh_file(entry.path().filename().string()))
        paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::string result;
    for (const std::filesystem::path &path : paths)
      result +=
        text(path.filename().string(), ' ', checksum_of_file(path), '\n');
    return result;
  }



  void
  check_read(const Hdf5InputFile &file)
  {
    AssertThrow(file.error().empty(),
                ExcUser("The checkpoint file '" + file.path().string() +
                        "' cannot be used: " + file.error() +
                        ". Resume with the version of talus that wrote the "
                        "file, or remove the checkpoint, so that the previous "
                        "one is used."));
  }



  template decltype(save_points<2>) save_points<2>;
  template decltype(save_points<3>) save_points<3>;
  template decltype(load_points<2>) load_points<2>;
  template decltype(load_points<3>) load_points<3>;
} // namespace talus

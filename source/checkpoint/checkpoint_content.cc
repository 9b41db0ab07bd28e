// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_content.h>
#include <talus/io/checksum.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// For readers of the file who do not have this program.
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



    /// A slash in a name would make a group of its own in HDF5.
    std::string
    checked(const std::string &name)
    {
      AssertThrow(name.find('/') == std::string::npos,
                  ExcInternalError("'" + name + "' must not have a slash."));
      return name;
    }



    /// The file has the components of a point side by side, as h5py wants them;
    /// points have a row per component. @p first is the first row of this rank.
    /// The number of rows and columns follows from the file, so what another
    /// version wrote is noticed. Collective.
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
      /// HDF5's own error is part of the sentence.
      check_read(file);
      AssertThrow(file.shape(name).second == n,
                  ExcUser("In '" + file.path().string() + "' the column '" +
                          column.name +
                          "' has another number of components than now. Resume "
                          "with the version of talus that wrote it."));
      for (unsigned int c = 0; c < n; ++c)
        for (unsigned int p = 0; p < points.size(); ++p)
          points.data(column.first, c)[p] = rows[std::size_t(n) * p + c];
    }
  } // namespace



  /// Attributes of the file: h5dump shows them without reading any array.
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



  /// The format comes first: of another format the other entries may not be
  /// there.
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



  /// Columns by name, in the order of the cells, whatever rank owns them:
  /// another number of ranks reads the same rows in other portions. How many
  /// points a cell has is saved, too, so that they need not be searched for,
  /// and the order within a cell, on which sums depend, comes back as it was.
  /// Collective.
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
    // One column at a time: a checkpoint takes the memory of the largest one.
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



  /// The partition is state: it decides in which order the sums of ranks are
  /// taken.
  std::vector<double>
  load_cell_weights(Hdf5InputFile &file, const unsigned int n_cells)
  {
    return file.read("cells/weight",
                     file.first_and_total(n_cells).first,
                     n_cells);
  }



  /// Cells of this rank begin where those of the ranks before it end, in the
  /// file and along p4est's curve alike; points follow from the numbers of
  /// points per cell. More or fewer columns than now would be state that is
  /// lost or made up, so both are errors. Collective.
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
                        "' has another number of cells than its mesh. Remove "
                        "this checkpoint so that the one before it is used."));
    const double n_points =
      std::accumulate(points_of_cell.begin(), points_of_cell.end(), 0.);
    points.append(static_cast<unsigned int>(n_points));

    AssertThrow(file.names("points").size() == points.columns().size(),
                ExcUser("In '" + file.path().string() +
                        "' the points have other columns than now. Resume "
                        "with the version of talus that wrote it."));
    const std::uint64_t first = file.first_and_total(points.size()).first;
    for (const Column &column : points.columns())
      load_column(file, column, first, points);

    std::vector<unsigned int> cells;
    for (unsigned int c = 0; c < n_cells; ++c)
      cells.insert(cells.end(), points_of_cell[c], c);
    return cells;
  }



  /// Each rank's share by itself, not the sum: on the same number of ranks
  /// every rank gets its own back, and with it the same round-off. Collective.
  void
  save_state(Hdf5OutputFile &file, const StateList &list)
  {
    std::vector<double> own;
    for (const StateList::Number &number : list.numbers())
      own.push_back(number.get());
    const auto of_ranks = Utilities::MPI::all_gather(file.communicator(), own);

    file.create_group("state");
    for (unsigned int i = 0; i < own.size(); ++i)
      {
        const StateList::Number &number = list.numbers()[i];
        const std::string        name   = "state/" + checked(number.name);
        std::vector<double>      shares;
        for (const std::vector<double> &numbers : of_ranks)
          shares.push_back(numbers[i]);
        // After the exchange all ranks know all shares: one message for all
        // numbers.
        file.write_known(name, shares);
        file.set_attribute(name, "unit", number.unit);
        file.set_attribute(name, "over ranks", name_of(number.reduction));
      }
    file.create_group("text");
    for (const StateList::Text &text : list.texts())
      file.write_text("text/" + checked(text.name), text.get());
    for (const StateList::Table &table : list.tables())
      {
        if (&table == &list.tables().front())
          file.create_group("tables");
        const std::string name = "tables/" + checked(table.name);
        file.write(name, table.get(), table.n_columns);
        file.set_attribute(name, "columns", table.columns);
      }
  }



  /// What a share becomes on another number of ranks is the business of
  /// restored_share(): sums and maxima of the whole run stay what they were.
  /// Collective.
  void
  load_state(Hdf5InputFile &file, const StateList &list)
  {
    const MPI_Comm      communicator = file.communicator();
    const unsigned int  n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int  rank = Utilities::MPI::this_mpi_process(communicator);
    const std::uint64_t n_ranks_then = file.integer_attribute("/", "ranks");
    for (const StateList::Number &number : list.numbers())
      {
        // A number that this program has and the file has not ends in
        // check_read().
        const std::vector<double> shares =
          file.read("state/" + number.name, 0, n_ranks_then);
        check_read(file);
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
                            "' has another number of columns than now. Resume "
                            "with the version of talus that wrote it."));
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



  /// Sorted, as the order of a folder is nobody's promise. What others put
  /// there, as a user's notes or what a file system keeps of a file that was
  /// removed while it was open, does not count.
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
                        ". Resume with the version of talus that wrote it, or "
                        "remove this checkpoint so that the one before it is "
                        "used."));
  }



  template decltype(save_points<2>) save_points<2>;
  template decltype(save_points<3>) save_points<3>;
  template decltype(load_points<2>) load_points<2>;
  template decltype(load_points<3>) load_points<3>;
} // namespace talus

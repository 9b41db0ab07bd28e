// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/checkpoint/checkpoint_content.h>
#include <talus/io/checksum.h>

#include <fstream>
#include <map>
#include <sstream>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  void
  save_head(Hdf5Image &file, const CheckpointHead &head)
  {
    file.write("head/dimension", {1. * head.dimension});
    file.write("head/ranks", {1. * head.n_ranks});
    file.write("head/step", {1. * head.step});
    file.write("head/time [s]", {head.time});
    file.write("head/end time [s]", {head.end_time});
    file.write_text("head/talus version", head.version);
    file.write_text("head/git revision", head.revision);
  }



  CheckpointHead
  load_head(const Hdf5Image &file)
  {
    CheckpointHead head;
    head.dimension = file.read_number("head/dimension");
    head.n_ranks   = file.read_number("head/ranks");
    head.step      = file.read_number("head/step");
    head.time      = file.read_number("head/time [s]");
    head.end_time  = file.read_number("head/end time [s]");
    head.version   = file.read_text("head/talus version");
    head.revision  = file.read_text("head/git revision");
    return head;
  }



  namespace
  {
    constexpr const char *name_of_numbers = "state/numbers";
    constexpr const char *name_of_columns = "text/columns of the state";
    constexpr const char *name_of_points  = "text/columns of the points";

    /// Name, unit and number of components of each column, one per line.
    template <int dim>
    std::string
    columns_of(const Points<dim> &points)
    {
      std::string lines;
      for (const Column &column : points.columns())
        lines +=
          text(column.name, '\t', column.unit, '\t', column.n_components, '\n');
      return lines;
    }



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



    /// Return the rows of all ranks, on the first rank. Collective.
    std::vector<double>
    gathered(const std::vector<double> &own, const MPI_Comm communicator)
    {
      std::vector<double> all;
      for (const auto &rows : Utilities::MPI::gather(communicator, own))
        all.insert(all.end(), rows.begin(), rows.end());
      return all;
    }



    /// Return the content of a file, which the first rank reads; empty if there
    /// is no file. Collective.
    std::string
    bytes_of(const fs::path &path, const MPI_Comm communicator)
    {
      std::ostringstream bytes;
      if (is_first_rank(communicator))
        bytes << std::ifstream(path, std::ios::binary).rdbuf();
      return Utilities::MPI::broadcast(communicator, bytes.str());
    }
  } // namespace



  template <int dim>
  void
  save_columns(Hdf5Image &file, const Points<dim> &points)
  {
    file.write_text(name_of_points, columns_of(points));
  }



  /// A missing or additional column would be lost or invented state: both are
  /// errors.
  template <int dim>
  void
  check_columns(const Hdf5Image &file, const Points<dim> &points)
  {
    AssertThrow(file.read_text(name_of_points) == columns_of(points),
                ExcUser("In the checkpoint the points have different columns "
                        "from this version of talus. Resume with the version "
                        "of talus that wrote the checkpoint."));
  }



  /// The value of each rank is saved, not the sum: with the same number of
  /// ranks every rank gets its own value back with identical round-off. All
  /// numbers are in one array with a column per number, because the time of
  /// HDF5 grows with the square of the number of arrays in a group. Collective.
  void
  save_state(Hdf5Image       &file,
             const StateList &list,
             const MPI_Comm   communicator)
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
    file.write(name_of_numbers, gathered(own, communicator), own.size());
    file.write_text(name_of_columns, columns);
    for (const StateList::Text &text : list.texts())
      file.write_text("text/" + text.name, text.get());
    for (const StateList::Table &table : list.tables())
      {
        const std::vector<double> rows = table.get();
        file.write("tables/" + table.name,
                   table.is_common ? rows : gathered(rows, communicator),
                   table.n_columns);
        file.write_text("text/columns of " + table.name, table.columns);
      }
  }



  /// restored_share() computes the values for another number of ranks: sums and
  /// maxima of the whole run are unchanged.
  void
  load_state(const Hdf5Image &file,
             const StateList &list,
             const MPI_Comm   communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    std::istringstream lines(file.read_text(name_of_columns));
    std::map<std::string, std::size_t> columns; // by name of the number
    for (std::string line; std::getline(lines, line);)
      columns.emplace(line.substr(0, line.find('\t')), columns.size());
    const std::vector<double> values =
      file.read(name_of_numbers, columns.size());
    for (const StateList::Number &number : list.numbers())
      {
        const auto column = columns.find(number.name);
        AssertThrow(column != columns.end(),
                    ExcUser("In the checkpoint the number '" + number.name +
                            "' is missing, which this version of talus needs. "
                            "Resume with the version of talus that wrote the "
                            "checkpoint."));
        std::vector<double> shares;
        for (std::size_t i = column->second; i < values.size();
             i += columns.size())
          shares.push_back(values[i]);
        number.set(restored_share(shares, number.reduction, rank, n_ranks));
      }
    for (const StateList::Text &text : list.texts())
      text.set(file.read_text("text/" + text.name));
    for (const StateList::Table &table : list.tables())
      table.set(file.read("tables/" + table.name, table.n_columns));
  }



  /// All ranks get a copy of the file, which is small without the points.
  Hdf5Image
  open_state(const fs::path &checkpoint, const MPI_Comm communicator)
  {
    const fs::path path = checkpoint / state_file_name;
    return Hdf5Image(bytes_of(path, communicator), path);
  }



  namespace
  {
    /// All files of a checkpoint but the list of checksums. deal.II's versions
    /// differ in the names for the mesh; a missing file has the checksum of an
    /// empty file.
    const std::vector<std::string> files = {mesh_file_name,
                                            "mesh.info",
                                            "mesh_fixed.data",
                                            "mesh_triangulation.data",
                                            points_file_name,
                                            state_file_name};

    /// Return the last line of the list of checksums.
    std::string
    own_checksum(const std::string &lines)
    {
      return text(checksums_file_name, ' ', checksum(lines), '\n');
    }
  } // namespace



  bool
  is_checkpoint_file(const std::string &name)
  {
    return name == checksums_file_name ||
           std::count(files.begin(), files.end(), name) > 0;
  }



  /// Files of the user in the folder are ignored, as are remains of open files
  /// removed on a network file system.
  std::string
  list_checksums(const fs::path &checkpoint, const MPI_Comm communicator)
  {
    std::string lines = text("format ", checkpoint_format, '\n');
    for (const std::string &name : files)
      lines += text(name,
                    ' ',
                    checksum_of_file(checkpoint / name, communicator),
                    '\n');
    return lines + own_checksum(lines);
  }



  /// Everything is checked before anything is used: instead of a damaged
  /// checkpoint the previous one is loaded. Neither HDF5 nor p4est sees a
  /// damaged file.
  std::string
  find_damage(const fs::path &checkpoint, const MPI_Comm communicator)
  {
    const std::string saved =
      bytes_of(checkpoint / checksums_file_name, communicator);
    const std::size_t last = saved.rfind(checksums_file_name);
    if (last == saved.npos ||
        saved.substr(last) != own_checksum(saved.substr(0, last)))
      return text("'", checksums_file_name, "' is missing or damaged");

    std::istringstream expected(saved);
    std::string        line, expected_line;
    unsigned int       format = 0;
    std::getline(expected, line, ' ') >> format;
    AssertThrow(format == checkpoint_format,
                ExcUser(text("The checkpoint '",
                             checkpoint.string(),
                             "' has the format version ",
                             format,
                             ", but this talus reads version ",
                             checkpoint_format,
                             ". Resume with the version of talus that wrote "
                             "the checkpoint, or start a new run with "
                             "--overwrite.")));
    expected.seekg(0);
    std::istringstream found(list_checksums(checkpoint, communicator));
    while (std::getline(found, line))
      if (!std::getline(expected, expected_line) || line != expected_line)
        return "the checksum of '" + line.substr(0, line.find(' ')) +
               "' does not match its content";
    return "";
  }



  template decltype(save_columns<2>)  save_columns<2>;
  template decltype(save_columns<3>)  save_columns<3>;
  template decltype(check_columns<2>) check_columns<2>;
  template decltype(check_columns<3>) check_columns<3>;
} // namespace talus

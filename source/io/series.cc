// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/series.h>
#include <talus/io/vtu_writer.h>

#include <deal.II/base/utilities.h>

#include <iomanip>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    std::filesystem::path
    path_of_index(const std::filesystem::path &folder, const std::string &name)
    {
      return folder / (name + ".pvd");
    }
  } // namespace



  void
  FieldSeries::begin(const std::filesystem::path &folder,
                     const std::string           &name,
                     const MPI_Comm               communicator,
                     const Beginning              beginning)
  {
    folder_       = folder;
    name_         = name;
    communicator_ = communicator;
    if (beginning == Beginning::fresh)
      entries_.clear();
    n_synced_ = entries_.size();
  }



  /// As text, since a list of names and times has no fixed length. 17 digits
  /// restore each double exactly.
  void
  FieldSeries::list_state(const std::string &name, StateList &list)
  {
    const auto get = [this]() {
      std::string lines;
      for (const Entry &entry : entries_)
        lines += text(std::setprecision(17), entry.time, ' ', entry.file, '\n');
      return lines;
    };
    const auto set = [this](const std::string &lines) {
      entries_.clear();
      std::istringstream words(lines);
      for (Entry entry; words >> entry.time >> entry.file;)
        entries_.push_back(entry);
    };
    list.add_text({name, get, set});
  }



  /// The number of the output is the number of entries: a resumed run
  /// overwrites files from after the checkpoint. The index is written after the
  /// files of the index, each time as a whole: ParaView finds no name without a
  /// file.
  void
  FieldSeries::write(const OutputCells &cells)
  {
    const std::string file =
      name_ + "-" + Utilities::int_to_string(entries_.size(), 4) + ".vtu";
    write_vtu(folder_ / file, communicator_, cells);
    entries_.push_back({cells.time, file});
    if (is_first_rank(communicator_))
      write_index();
  }



  // deal.II's function for the index writes the date into the file and keeps
  // only 12 digits of the times.
  void
  FieldSeries::write_index() const
  {
    write_file(path_of_index(folder_, name_), [&](std::ostream &out) {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"Collection\" version=\"0.1\">\n"
             "  <Collection>\n";
      for (const Entry &entry : entries_)
        out << "    <DataSet timestep=\"" << csv_field(entry.time)
            << "\" group=\"\" part=\"0\" file=\"" << entry.file << "\"/>\n";
      out << "  </Collection>\n</VTKFile>\n";
    });
  }



  std::vector<std::string>
  FieldSeries::missing_files(const std::filesystem::path &folder,
                             const std::string           &name) const
  {
    std::vector<std::string>    missing;
    const std::filesystem::path index = path_of_index(folder, name);
    if (!entries_.empty() && !std::filesystem::exists(index))
      missing.push_back(index.filename());
    for (const Entry &entry : entries_)
      if (!is_complete_vtu(folder / entry.file))
        missing.push_back(entry.file);
    return missing;
  }



  /// Once per checkpoint, not per file: waiting for the disk often takes longer
  /// than writing. A missing file was moved by the user.
  void
  FieldSeries::sync()
  {
    if (!is_first_rank(communicator_) || n_synced_ == entries_.size())
      return;
    std::vector<std::filesystem::path> paths = {path_of_index(folder_, name_)};
    for (; n_synced_ < entries_.size(); ++n_synced_)
      paths.push_back(folder_ / entries_[n_synced_].file);
    for (const std::filesystem::path &path : paths)
      if (std::filesystem::exists(path))
        {
          const std::string error = sync_to_disk(path);
          AssertThrow(error.empty(), ExcUser(failed_write(path, error)));
        }
  }
} // namespace talus

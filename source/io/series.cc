// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/series.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace talus
{
  using namespace dealii;

  void
  FieldSeries::begin(const std::filesystem::path &folder,
                     const std::string           &name,
                     const MPI_Comm               communicator,
                     const std::string           &format,
                     const Beginning              beginning)
  {
    folder_       = folder;
    name_         = name;
    communicator_ = communicator;
    writer_       = make_field_writer(format);
    unsynced_.clear();
    if (beginning == Beginning::fresh)
      entries_.clear();
  }



  /// As text, since a list of names and times has no fixed length. 17 digits
  /// restore each double exactly. Lines of a description begin with a blank,
  /// lines of an entry do not.
  void
  FieldSeries::list_state(const std::string &name, StateList &list)
  {
    const auto get = [this]() {
      std::ostringstream out;
      out << std::setprecision(17);
      for (const IndexEntry &entry : entries_)
        out << entry.time << ' ' << entry.file << '\n' << entry.description;
      return out.str();
    };
    const auto set = [this, name](const std::string &text) {
      entries_.clear();
      std::istringstream in(text);
      for (std::string line; std::getline(in, line);)
        if (line[0] == ' ' && !entries_.empty())
          entries_.back().description += line + '\n';
        else
          {
            IndexEntry         entry;
            std::istringstream words(line);
            words >> entry.time >> entry.file;
            AssertThrow(
              line[0] != ' ' && words,
              ExcUser(
                "The list '" + name + "' of the checkpoint has '" + line +
                "' where the time and the name of a file were expected. "
                "Remove this checkpoint, to use the previous checkpoint."));
            entries_.push_back(entry);
          }
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
    const std::string base =
      name_ + "-" + Utilities::int_to_string(entries_.size(), 4);
    entries_.push_back(
      writer_->write(folder_, base, communicator_, cells, unsynced_));
    if (!is_first_rank(communicator_))
      return;
    unsynced_.push_back(writer_->write_index(folder_, name_, entries_));
  }



  std::vector<std::string>
  FieldSeries::missing_files(const std::filesystem::path &folder,
                             const std::string           &name,
                             const std::string           &format) const
  {
    if (entries_.empty())
      return {};
    const auto               writer = make_field_writer(format);
    std::vector<std::string> missing;
    if (!std::filesystem::exists(folder / writer->index_name(name)))
      missing.push_back(writer->index_name(name));
    for (const IndexEntry &entry : entries_)
      for (const std::string &file : writer->files_of(folder, entry))
        if (!std::filesystem::exists(folder / file) ||
            !writer->is_complete(folder / file))
          missing.push_back(file);
    return missing;
  }



  /// Once per checkpoint, not per file: waiting for the disk often takes longer
  /// than writing.
  void
  FieldSeries::sync()
  {
    // The index was written once for each time. A missing file was moved by the
    // user.
    std::sort(unsynced_.begin(), unsynced_.end());
    unsynced_.erase(std::unique(unsynced_.begin(), unsynced_.end()),
                    unsynced_.end());
    for (const std::filesystem::path &path : unsynced_)
      if (std::filesystem::exists(path))
        {
          const std::string error = sync_to_disk(path);
          AssertThrow(error.empty(), ExcUser(failed_write(path, error)));
        }
    unsynced_.clear();
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/folder_lock.h>
#include <talus/io/output_folder.h>
#include <talus/io/run_record.h>

#include <cstdlib>
#include <regex>
#include <vector>

namespace talus
{
  using namespace dealii;
  namespace fs = std::filesystem;

  // All names are listed here, not with the writers: an earlier run may have
  // written files that the present run does not write.
  bool
  is_output_name(const std::string &file_name)
  {
    static const std::regex names(
      "(statistics|profile|obstacles|boundaries|newton|maps|stations|lines)"
      "\\.csv|log\\.txt|parameters\\.prm|maps\\.vtu|"
      "maps/(ground|erosion|thickness-at-start|final-(thickness|mass)|"
      "(time-of-)?maximum-(thickness|speed|momentum-flux|bed-shear)|"
      "arrival-time-[-+.0-9e]*-m)\\.(asc|prj|tif)|"
      "(points|grid|facets|obstacles|mechanism|no-equilibrium|last-state)"
      "([-.][-.0-9]*)?\\.(vtu|pvtu|pvd|h5|xdmf)");
    return std::regex_match(file_name, names);
  }



  namespace
  {
    bool
    has_ending(const std::string &name, const std::string &ending)
    {
      return name.size() >= ending.size() &&
             name.compare(name.size() - ending.size(), ending.size(), ending) ==
               0;
    }



    /// Return the files of @p type in a folder, or the targets of links, that
    /// are named as outputs followed by @p ending.
    std::vector<fs::path>
    outputs_in(const fs::path     &folder,
               const std::string  &ending = "",
               const fs::file_type type   = fs::file_type::regular)
    {
      std::vector<fs::path> result;
      for (const std::string within : {"", "maps/"})
        {
          std::error_code error, ignored;
          for (fs::directory_iterator entry(folder / within, error), end;
               !error && entry != end;
               entry.increment(error))
            if (const std::string name = entry->path().filename().string();
                entry->status(ignored).type() == type &&
                has_ending(name, ending) &&
                is_output_name(within +
                               name.substr(0, name.size() - ending.size())))
              result.push_back(entry->path());
        }
      return result;
    }
  } // namespace



  namespace
  {
    /// Return whether a folder can be written, by making and removing a
    /// subfolder: permissions are no answer for root, nor on file systems
    /// without new files, such as /proc.
    bool
    can_hold_folders(const fs::path &folder)
    {
      std::string name = (folder / ".talus-XXXXXX").string();
      if (::mkdtemp(name.data()) == nullptr)
        return false;
      std::error_code error;
      return fs::remove(name, error);
    }
  } // namespace



  // Checks the existing part of the path.
  void
  check_can_be_made(const fs::path &folder)
  {
    std::error_code error;
    fs::path        there = fs::absolute(folder, error);
    while (there.has_relative_path() && !fs::exists(there, error))
      there = there.parent_path();
    const bool is_folder = fs::is_directory(there, error);
    AssertThrow(is_folder && can_hold_folders(there),
                ExcUser(
                  text("The output folder '",
                       folder.string(),
                       "' cannot be made or written ('",
                       there.string(),
                       is_folder ? "' cannot be written" : "' is not a folder",
                       "). Choose another one with Output/Folder or "
                       "--output.")));
  }



  namespace
  {
    std::string
    foreign_record(const fs::path &record, const Beginning beginning)
    {
      const bool is_there =
        fs::symlink_status(record).type() != fs::file_type::not_found;
      if (!is_there || is_run_record(record))
        return "";
      return text("The output folder '",
                  record.parent_path().string(),
                  "' holds a file 'parameters.prm' that no run has written "
                  "or somebody has changed, and this run would write over "
                  "the file. Move the file",
                  beginning == Beginning::resumed
                    ? ", and resume with the moved file or another parameter "
                      "file."
                    : ", or choose another folder with Output/Folder or "
                      "--output.");
    }



    /// Return an error for results without the record of a run: the owner is
    /// unknown.
    std::string
    results_without_a_run(const fs::path &folder)
    {
      const std::vector<fs::path> found = outputs_in(folder);
      if (found.empty())
        return "";
      return text("The output folder '",
                  folder.string(),
                  "' holds '",
                  found.front().string(),
                  "', named like the output of a run, but no "
                  "'parameters.prm' of a run: the file may be yours. Move "
                  "the file, or choose another folder with Output/Folder or "
                  "--output.");
    }
  } // namespace



  namespace
  {
    /// Return an error for pipes: opening a pipe would wait for a reader.
    std::string
    pipe_of_others(const fs::path &folder)
    {
      const std::vector<fs::path> found =
        outputs_in(folder, "", fs::file_type::fifo);
      if (found.empty())
        return "";
      return text("The output folder '",
                  folder.string(),
                  "' holds a pipe '",
                  found.front().string(),
                  "', where the run writes a file of the same name. Remove "
                  "the pipe, or choose another folder with Output/Folder or "
                  "--output.");
    }
  } // namespace



  std::string
  foreign_file(const fs::path &folder, const Beginning beginning)
  {
    if (const std::string sentence = pipe_of_others(folder); !sentence.empty())
      return sentence;
    if (const std::string sentence = foreign_lock(folder); !sentence.empty())
      return sentence;
    // write_file() makes the file under another name first.
    for (const std::string ending : {"", ".part"})
      for (const fs::path &path : outputs_in(folder, ending))
        if (const std::string sentence = clash_with_input(path);
            !sentence.empty())
          return sentence;
    const fs::path    record   = folder / "parameters.prm";
    const std::string sentence = foreign_record(record, beginning);
    return sentence.empty() && beginning == Beginning::fresh &&
               !is_run_record(record)
             ? results_without_a_run(folder)
             : sentence;
  }



  namespace
  {
    void
    remove_result(const fs::path &path)
    {
      std::error_code error;
      fs::remove(path, error);
      AssertThrow(!error,
                  ExcUser(text("The file '",
                               path.string(),
                               "' of an earlier run could not be removed (",
                               error.message(),
                               "). Remove it, or choose another folder "
                               "with Output/Folder or --output.")));
    }
  } // namespace



  void
  remove_earlier_results(const fs::path &folder)
  {
    const fs::path record = folder / "parameters.prm";
    for (const std::string ending : {"", ".part"})
      for (const fs::path &path : outputs_in(folder, ending))
        if (path != record)
          remove_result(path);
  }



  void
  remove_remains(const fs::path &folder)
  {
    for (const fs::path &path : outputs_in(folder, ".part"))
      remove_result(path);
    for (const fs::path &path : outputs_in(folder))
      if (path.filename().string().rfind("last-state", 0) == 0)
        remove_result(path);
  }
} // namespace talus

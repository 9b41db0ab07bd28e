#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/io/files.h>
#include <talus/io/hdf5_output.h>
#include <talus/io/series.h>
#include <talus/io/vtu.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // deal.II's function of this kind writes the date into the file and keeps
    // only 12 digits of the times.
    void
    write_pvd(
      std::ostream                                      &out,
      const std::vector<std::pair<double, std::string>> &times_and_names)
    {
      out << "<?xml version=\"1.0\"?>\n"
             "<VTKFile type=\"Collection\" version=\"0.1\">\n"
             "  <Collection>\n"
          << std::setprecision(16);
      for (const auto &[time, name] : times_and_names)
        out << "    <DataSet timestep=\"" << time
            << "\" group=\"\" part=\"0\" file=\"" << name << "\"/>\n";
      out << "  </Collection>\n</VTKFile>\n";
    }
  } // namespace



  void
  FieldSeries::begin(const std::filesystem::path &folder,
                     const std::string           &name,
                     const MPI_Comm               communicator,
                     const FieldFormat            format,
                     const Beginning              beginning)
  {
    folder_       = folder;
    name_         = name;
    communicator_ = communicator;
    format_       = format;
    unsynced_.clear();
    xdmf_ = XdmfIndex();
    if (beginning == Beginning::anew)
      times_and_names_.clear();
  }



  void
  FieldSeries::list_state(const std::string &name, StateList &list)
  {
    const auto get = [this]() {
      std::ostringstream out;
      out << std::setprecision(17);
      for (const auto &[time, file] : times_and_names_)
        out << time << ' ' << file << '\n';
      return out.str();
    };
    const auto set = [this](const std::string &text) {
      times_and_names_.clear();
      std::istringstream in(text);
      double             time;
      std::string        file;
      while (in >> time >> file)
        times_and_names_.emplace_back(time, file);
    };
    list.add_text({name, get, set});
  }



  template <int cell_dim, int dim>
  void
  FieldSeries::write(const OutputCells<cell_dim, dim> &cells,
                     const double                      time,
                     const unsigned long               step)
  {
    const std::string base =
      name_ + "-" + Utilities::int_to_string(times_and_names_.size(), 4);
    std::string file = base + ".h5";
    if (format_ == FieldFormat::hdf5)
      write_hdf5(folder_ / file, communicator_, cells, time, step);
    else
      file =
        write_vtu(folder_, base, communicator_, cells, time, step, unsynced_);
    times_and_names_.emplace_back(time, file);
    if (is_first_rank(communicator_))
      unsynced_.push_back(write_index());
  }



  /// Returns its path.
  std::filesystem::path
  FieldSeries::write_index()
  {
    const bool                  is_hdf5 = (format_ == FieldFormat::hdf5);
    const std::filesystem::path path =
      folder_ / (name_ + (is_hdf5 ? ".xdmf" : ".pvd"));
    if (is_hdf5)
      xdmf_.write(path, times_and_names_);
    else
      write_file(path,
                 [&](std::ostream &out) { write_pvd(out, times_and_names_); });
    return path;
  }



  void
  FieldSeries::sync()
  {
    // The index was written once for each time. A file that is not there any
    // more was moved by somebody.
    std::sort(unsynced_.begin(), unsynced_.end());
    unsynced_.erase(std::unique(unsynced_.begin(), unsynced_.end()),
                    unsynced_.end());
    for (const std::filesystem::path &path : unsynced_)
      if (std::filesystem::exists(path))
        {
          const std::string complaint = sync_to_disk(path);
          AssertThrow(complaint.empty(),
                      ExcUser(failed_write(path, complaint)));
        }
    unsynced_.clear();
  }



#define INSTANTIATE(cell_dim, dim)                                     \
  template void FieldSeries::write(const OutputCells<cell_dim, dim> &, \
                                   double,                             \
                                   unsigned long);

  INSTANTIATE(0, 2)
  INSTANTIATE(0, 3)
  INSTANTIATE(2, 2)
  INSTANTIATE(3, 3)
#undef INSTANTIATE
} // namespace talus

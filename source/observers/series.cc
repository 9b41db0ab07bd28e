#include <talus/observers/files.h>
#include <talus/observers/hdf5_output.h>
#include <talus/observers/series.h>
#include <talus/observers/vtu.h>

#include <deal.II/base/utilities.h>

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
    xdmf_         = XdmfIndex();
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
      file = write_vtu(folder_, base, communicator_, cells, time, step);
    times_and_names_.emplace_back(time, file);
    if (Utilities::MPI::this_mpi_process(communicator_) == 0)
      write_index();
  }



  void
  FieldSeries::write_index()
  {
    if (format_ == FieldFormat::hdf5)
      xdmf_.write(folder_ / (name_ + ".xdmf"), times_and_names_);
    else
      write_file(folder_ / (name_ + ".pvd"),
                 [&](std::ostream &out) { write_pvd(out, times_and_names_); });
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

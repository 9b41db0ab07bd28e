#include <talus/observers/files.h>
#include <talus/observers/vtu.h>

#include <deal.II/grid/reference_cell.h>

#include <iomanip>

namespace talus
{
  using namespace dealii;

  template <int patch_dim, int dim>
  Patches<patch_dim, dim>::Patches(const std::vector<Field> &fields)
    : fields_(fields)
  {
    std::size_t n_components = 0;
    for (const Field &field : fields_)
      n_components += field.n_components;
    values_.resize(n_components);
  }



  template <int patch_dim, int dim>
  void
  Patches<patch_dim, dim>::reserve(const unsigned int n)
  {
    patches_.reserve(patches_.size() + n);
  }



  template <int patch_dim, int dim>
  void
  Patches<patch_dim, dim>::add(
    const std::array<Point<dim>, (1 << patch_dim)>   &vertices,
    const std::array<unsigned int, (1 << patch_dim)> &items)
  {
    Patch patch;
    patch.patch_index = patches_.size();
    if constexpr (patch_dim > 0)
      patch.reference_cell = ReferenceCells::get_hypercube<patch_dim>();
    patch.data.reinit(values_.size(), items.size());
    for (unsigned int v = 0; v < items.size(); ++v)
      {
        patch.vertices[v] = vertices[v];
        // The vertices of a point's box share its values.
        if (v == 0 || items[v] != items[v - 1])
          {
            float *to = values_.data();
            for (const Field &field : fields_)
              {
                field.evaluate(items[v], to);
                to += field.n_components;
              }
          }
        for (unsigned int c = 0; c < values_.size(); ++c)
          patch.data(c, v) = values_[c];
      }
    patches_.push_back(std::move(patch));
  }



  template <int patch_dim, int dim>
  void
  Patches<patch_dim, dim>::write(std::ostream       &out,
                                 const double        time,
                                 const unsigned long step)
  {
    DataOutBase::VtkFlags flags;
    flags.time                = time;
    flags.cycle               = step;
    flags.print_date_and_time = false;
    flags.compression_level   = DataOutBase::VtkFlags::best_speed;
    this->set_flags(flags);
    this->write_vtu(out);
  }



  template <int patch_dim, int dim>
  const std::vector<typename Patches<patch_dim, dim>::Patch> &
  Patches<patch_dim, dim>::get_patches() const
  {
    return patches_;
  }



  template <int patch_dim, int dim>
  std::vector<std::string>
  Patches<patch_dim, dim>::get_dataset_names() const
  {
    std::vector<std::string> names;
    for (const Field &field : fields_)
      for (unsigned int c = 0; c < field.n_components; ++c)
        names.push_back(field.name);
    return names;
  }



  template <int patch_dim, int dim>
  std::vector<
    std::tuple<unsigned int,
               unsigned int,
               std::string,
               DataComponentInterpretation::DataComponentInterpretation>>
  Patches<patch_dim, dim>::get_nonscalar_data_ranges() const
  {
    namespace Interpretation = DataComponentInterpretation;
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           Interpretation::DataComponentInterpretation>>
                 ranges;
    unsigned int first = 0;
    for (const Field &field : fields_)
      {
        const unsigned int last = first + field.n_components - 1;
        if (field.kind == FieldKind::vector)
          ranges.emplace_back(first,
                              last,
                              field.name,
                              Interpretation::component_is_part_of_vector);
        else if (field.kind == FieldKind::tensor)
          ranges.emplace_back(first,
                              last,
                              field.name,
                              Interpretation::component_is_part_of_tensor);
        first = last + 1;
      }
    return ranges;
  }



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
  VtuSeries::begin(const std::filesystem::path &folder,
                   const std::string           &name,
                   const MPI_Comm               communicator,
                   const Beginning              beginning)
  {
    folder_       = folder;
    name_         = name;
    communicator_ = communicator;
    if (beginning == Beginning::anew)
      times_and_names_.clear();
  }



  void
  VtuSeries::list_state(const std::string &name, StateList &list)
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



  template <int patch_dim, int dim>
  void
  VtuSeries::write(Patches<patch_dim, dim> &patches,
                   const double             time,
                   const unsigned long      step)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator_);
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator_);
    const std::string  base =
      name_ + "-" + Utilities::int_to_string(times_and_names_.size(), 4);
    const auto piece = [&](const unsigned int r) {
      return base + (n_ranks > 1 ? "." + std::to_string(r) : "") + ".vtu";
    };

    write_file(folder_ / piece(rank),
               [&](std::ostream &out) { patches.write(out, time, step); });
    times_and_names_.emplace_back(time,
                                  n_ranks > 1 ? base + ".pvtu" : piece(0));
    if (rank != 0)
      return;

    if (n_ranks > 1)
      {
        std::vector<std::string> pieces;
        for (unsigned int r = 0; r < n_ranks; ++r)
          pieces.push_back(piece(r));
        write_file(folder_ / (base + ".pvtu"), [&](std::ostream &out) {
          // deal.II leaves no choice but to write the date, as a comment.
          std::stringstream record;
          patches.write_pvtu_record(record, pieces);
          for (std::string line; std::getline(record, line);)
            if (line.find("#This file was generated") == std::string::npos)
              out << line << '\n';
        });
      }
    write_file(folder_ / (name_ + ".pvd"),
               [&](std::ostream &out) { write_pvd(out, times_and_names_); });
  }



#define INSTANTIATE(patch_dim, dim)                         \
  template class Patches<patch_dim, dim>;                   \
  template void VtuSeries::write(Patches<patch_dim, dim> &, \
                                 double,                    \
                                 unsigned long);

  INSTANTIATE(0, 2)
  INSTANTIATE(0, 3)
  INSTANTIATE(2, 2)
  INSTANTIATE(3, 3)
#undef INSTANTIATE
} // namespace talus

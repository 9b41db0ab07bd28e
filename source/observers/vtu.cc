#include <talus/observers/files.h>
#include <talus/observers/vtu.h>

#include <deal.II/grid/reference_cell.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int patch_dim, int dim>
  Patches<patch_dim, dim>::Patches(const OutputCells<patch_dim, dim> &cells)
    : fields_(cells.fields)
  {
    std::size_t n_components = 0;
    for (const Field &field : fields_)
      n_components += field.n_components;
    values_.resize(n_components);
    patches_.reserve(cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      add(cells, c);
  }



  template <int patch_dim, int dim>
  void
  Patches<patch_dim, dim>::add(const OutputCells<patch_dim, dim> &cells,
                               const unsigned int                 c)
  {
    constexpr unsigned int n = OutputCells<patch_dim, dim>::n_vertices;
    Patch                  patch;
    patch.patch_index = c;
    if constexpr (patch_dim > 0)
      patch.reference_cell = ReferenceCells::get_hypercube<patch_dim>();
    patch.data.reinit(values_.size(), n);
    for (unsigned int v = 0; v < n; ++v)
      {
        patch.vertices[v] = cells.vertices[c * n + v];
        // The vertices of a point's box share its values.
        if (v == 0 || cells.items_at == ItemsAt::vertices)
          {
            float *to = values_.data();
            for (const Field &field : fields_)
              {
                field.evaluate(cells.item(c, v), to);
                to += field.n_components;
              }
          }
        for (unsigned int i = 0; i < values_.size(); ++i)
          patch.data(i, v) = values_[i];
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



  template <int cell_dim, int dim>
  std::string
  write_vtu(const std::filesystem::path      &folder,
            const std::string                &base,
            const MPI_Comm                    communicator,
            const OutputCells<cell_dim, dim> &cells,
            const double                      time,
            const unsigned long               step)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(communicator);
    const auto         piece   = [&](const unsigned int r) {
      return base + (n_ranks > 1 ? "." + std::to_string(r) : "") + ".vtu";
    };

    // ParaView complains about the files that deal.II writes without cells:
    // only ranks with cells write one, the first if nobody has any.
    const auto n_cells = Utilities::MPI::all_gather(communicator, cells.size());
    const bool nobody  = std::all_of(n_cells.begin(),
                                    n_cells.end(),
                                    [](const auto n) { return n == 0; });
    const auto writes  = [&](const unsigned int r) {
      return n_cells[r] > 0 || (nobody && r == 0);
    };

    Patches<cell_dim, dim> patches(cells);
    if (writes(rank))
      write_file(folder / piece(rank),
                 [&](std::ostream &out) { patches.write(out, time, step); });
    if (n_ranks == 1)
      return piece(0);

    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < n_ranks; ++r)
      if (writes(r))
        pieces.push_back(piece(r));
    if (rank == 0)
      write_file(folder / (base + ".pvtu"), [&](std::ostream &out) {
        // deal.II leaves no choice but to write the date, as a comment.
        std::stringstream record;
        patches.write_pvtu_record(record, pieces);
        for (std::string line; std::getline(record, line);)
          if (line.find("#This file was generated") == std::string::npos)
            out << line << '\n';
      });
    return base + ".pvtu";
  }



#define INSTANTIATE(cell_dim, dim)                                   \
  template class Patches<cell_dim, dim>;                             \
  template std::string write_vtu(const std::filesystem::path &,      \
                                 const std::string &,                \
                                 MPI_Comm,                           \
                                 const OutputCells<cell_dim, dim> &, \
                                 double,                             \
                                 unsigned long);

  INSTANTIATE(0, 2)
  INSTANTIATE(0, 3)
  INSTANTIATE(2, 2)
  INSTANTIATE(3, 3)
#undef INSTANTIATE
} // namespace talus

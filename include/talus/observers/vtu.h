#ifndef talus_observers_vtu_h
#define talus_observers_vtu_h

#include <talus/observers/output_cells.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

namespace talus
{
  /// Pieces of geometry, each with values at its vertices, that deal.II knows
  /// how to write: vertex cells (patch_dim = 0) or quads and hexes
  /// (patch_dim = dim). As dealii::Particles::DataOut, but with several fields
  /// and freely chosen geometry.
  template <int patch_dim, int dim>
  class Patches : public dealii::DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>;

    explicit Patches(const OutputCells<patch_dim, dim> &cells);

    /// The whole file as VTU, single precision, without date.
    void
    write(std::ostream &out, double time, unsigned long step);

  private:
    /// Append cell @p c.
    void
    add(const OutputCells<patch_dim, dim> &cells, unsigned int c);

    const std::vector<Patch> &
    get_patches() const override;

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<std::tuple<
      unsigned int,
      unsigned int,
      std::string,
      dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

    std::vector<Field> fields_;
    std::vector<float> values_;
    std::vector<Patch> patches_;
  };



  /// Write the cells as VTU into the folder, single precision, without date:
  /// one file base.vtu or, with several ranks, one base.R.vtu per rank R that
  /// has cells and base.pvtu. Collective. Returns the name of the file that
  /// ParaView is to open. Throws ExcUser if that fails.
  template <int cell_dim, int dim>
  std::string
  write_vtu(const std::filesystem::path      &folder,
            const std::string                &base,
            MPI_Comm                          communicator,
            const OutputCells<cell_dim, dim> &cells,
            double                            time,
            unsigned long                     step);
} // namespace talus

#endif

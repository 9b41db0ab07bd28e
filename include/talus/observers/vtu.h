#ifndef talus_observers_vtu_h
#define talus_observers_vtu_h

#include <talus/observers/files.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>

#include <filesystem>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace talus
{
  /// How ParaView is to read the components of a field.
  enum class FieldKind
  {
    scalar, ///< 1 component
    vector, ///< dim components, shown with 3
    tensor  ///< 9 components, row by row
  };



  /// A field of a VTU file: name with unit, and how to get its values.
  struct Field
  {
    std::string  name;
    FieldKind    kind;
    unsigned int n_components;
    /// Write the components at item @p i (a point, a node) to @p values.
    std::function<void(unsigned int i, float *values)> evaluate;
  };



  /// Pieces of geometry, each with values at its vertices, that deal.II knows
  /// how to write: vertex cells (patch_dim = 0) or quads and hexes
  /// (patch_dim = dim). As dealii::Particles::DataOut, but with several fields
  /// and freely chosen geometry.
  template <int patch_dim, int dim>
  class Patches : public dealii::DataOutInterface<patch_dim, dim>
  {
  public:
    using Patch = dealii::DataOutBase::Patch<patch_dim, dim>;

    explicit Patches(const std::vector<Field> &fields);

    /// Make room for @p n more patches.
    void
    reserve(unsigned int n);

    /// Append a patch with these vertices (deal.II's order) and fill in the
    /// fields: vertex v gets the values of item items[v].
    void
    add(const std::array<dealii::Point<dim>, (1 << patch_dim)> &vertices,
        const std::array<unsigned int, (1 << patch_dim)>       &items);

    /// The whole file as VTU, single precision, without date.
    void
    write(std::ostream &out, double time, unsigned long step);

  private:
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



  /// A sequence of VTU files over time: name-0000.vtu, name-0001.vtu, ... and
  /// name.pvd, which gives ParaView their times. With several ranks each output
  /// time has one name-NNNN.R.vtu per rank R and a name-NNNN.pvtu.
  class VtuSeries
  {
  public:
    /// Start anew, or go on after the files that were there at the checkpoint.
    void
    begin(const std::filesystem::path &folder,
          const std::string           &name,
          MPI_Comm                     communicator,
          Beginning                    beginning = Beginning::anew);

    /// Add the times and names of the files to the state of the run, as the
    /// text @p name: per file a line with the time [s], a space and the name.
    void
    list_state(const std::string &name, StateList &list);

    /// Write the files of the next output time; collective. Throws ExcUser if
    /// that fails.
    template <int patch_dim, int dim>
    void
    write(Patches<patch_dim, dim> &patches, double time, unsigned long step);

  private:
    std::filesystem::path                       folder_;
    std::string                                 name_;
    MPI_Comm                                    communicator_ = MPI_COMM_NULL;
    std::vector<std::pair<double, std::string>> times_and_names_;
  };
} // namespace talus

#endif

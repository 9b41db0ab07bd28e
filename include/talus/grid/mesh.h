// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_mesh_h
#define talus_grid_mesh_h

#include <talus/grid/mesh_layout.h>

#include <deal.II/distributed/tria.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// The p4est mesh on all ranks: refinement and coarsening, partition, saving
  /// and loading. Call Grid::prepare() after each change.
  template <int dim>
  class Mesh : public MeshLayout<dim>
  {
  public:
    using typename MeshLayout<dim>::Lattice;

    /// Whether the cell at @p place on @p level must be refined.
    using WantsFiner =
      std::function<bool(const Lattice &place, unsigned int level)>;

    /// Create the domain and its coarsest cells from the parameters. Throws
    /// ExcUser if the parameters are inconsistent.
    ///
    /// @param may_move for each face (see face_names) whether the face may move
    ///   outwards if the extent is not a multiple of the cell size or, with
    ///   @p grow, of the size of the largest cells
    /// @param grow whether cells far from soil may be larger than h
    /// @param periodic axes along which the mesh repeats
    void
    create(const std::array<bool, 2 * dim> &may_move,
           bool                             grow     = false,
           const std::array<bool, dim>     &periodic = {});

    /// Refine all cells down to h, and further in the refinement boxes.
    void
    refine();

    /// Refine the cells for which @p wants_finer is true and cells in
    /// refinement boxes, coarsen the others, and keep neighbours within a
    /// factor of two, until nothing changes. Cells stay on their rank unless
    /// @p spread is true, which distributes cells evenly. Return whether the
    /// mesh changed. Collective.
    bool
    refine(const WantsFiner &wants_finer, bool spread);

    /// Write the mesh to the file @p path and to files whose names begin with
    /// @p path. Collective.
    void
    save(const std::string &path) const;

    /// Load the mesh written by save(). Call after create() in place of
    /// refine(). p4est distributes the cells evenly among the ranks.
    /// Collective.
    void
    load(const std::string &path);

    /// Distribute the cells among the ranks by weight; @p weights has an entry
    /// for each owned cell in the order of the cells. Collective.
    void
    repartition(const std::vector<double> &weights);

    /// Active cells known to this rank, owned cells first, along the
    /// space-filling curve of p4est. The order depends on the mesh only and not
    /// on its history.
    std::vector<typename dealii::Triangulation<dim>::active_cell_iterator>
    cells_in_order() const;

    /// Edge of the smallest cells on all ranks, m.
    double
    finest_size() const
    {
      return this->size_of_level(triangulation_.n_global_levels() - 1);
    }

    /// Number of active cells on all ranks.
    unsigned long
    n_global_cells() const
    {
      return triangulation_.n_global_active_cells();
    }

    /// Number of cells owned by this rank.
    unsigned int
    n_locally_owned_cells() const
    {
      return triangulation_.n_locally_owned_active_cells();
    }

    MPI_Comm
    communicator() const
    {
      return triangulation_.get_communicator();
    }

    dealii::parallel::distributed::Triangulation<dim> &
    triangulation()
    {
      return triangulation_;
    }

    const dealii::parallel::distributed::Triangulation<dim> &
    triangulation() const
    {
      return triangulation_;
    }

  protected:
    explicit Mesh(MPI_Comm communicator);

  private:
    std::array<double, 2>
    flag_cells(const WantsFiner &wants_finer);
    bool
    can_join_cells();

    dealii::parallel::distributed::Triangulation<dim> triangulation_;
  };
} // namespace talus

#endif

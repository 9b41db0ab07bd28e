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
  /// The cells of p4est, on all ranks: how they are divided and joined, shared
  /// out, saved and loaded. After each change Grid::prepare() must follow.
  template <int dim>
  class Mesh : public MeshLayout<dim>
  {
  public:
    using typename MeshLayout<dim>::Lattice;

    /// Whether something in the cell at this place and level asks for smaller
    /// cells.
    using WantsFiner =
      std::function<bool(const Lattice &place, unsigned int level)>;

    /// Lay out the domain and its coarsest cells from the parameters.
    /// @p may_move tells for each face (see face_names) whether it may be moved
    /// outwards when the extent is not a multiple of the cell size, or, if
    /// cells are to @p grow far from soil, of the largest cells; along
    /// @p periodic axes the mesh repeats. Throws ExcUser if that is impossible.
    void
    create(const std::array<bool, 2 * dim> &may_move,
           bool                             grow     = false,
           const std::array<bool, dim>     &periodic = {});

    /// Divide all cells down to h, and further in the refinement boxes.
    void
    refine();

    /// Divide and join cells until those are divided that contain something
    /// that asks for it, those in the refinement boxes, and those that must be
    /// because neighbours differ by a factor of two at most. Cells stay on
    /// their rank unless they are to be @p spread evenly. Returns whether the
    /// mesh changed. Collective.
    bool
    refine(const WantsFiner &wants_finer, bool spread);

    /// Write the mesh to the file @p path and to others whose names begin like
    /// that. Collective.
    void
    save(const std::string &path) const;

    /// Make the mesh that save() wrote, after create() in place of refine().
    /// p4est then shares the cells evenly among the ranks. Collective.
    void
    load(const std::string &path);

    /// Share the cells out among the ranks by their weights; those of the cells
    /// this rank owns are given in the order of the cells. Collective.
    void
    repartition(const std::vector<double> &weights);

    /// The cells that this rank knows, in the order of p4est's space-filling
    /// curve, those it owns first: an order that depends on the mesh alone and
    /// not on how it came about.
    std::vector<typename dealii::Triangulation<dim>::active_cell_iterator>
    cells_in_order() const;

    /// Edge of the smallest cells, m.
    double
    finest_size() const
    {
      return this->size_of_level(triangulation_.n_global_levels() - 1);
    }

    /// Active cells of all ranks.
    unsigned long
    n_global_cells() const
    {
      return triangulation_.n_global_active_cells();
    }

    /// Cells that this rank owns.
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

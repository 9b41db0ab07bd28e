// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_mesh_layout_h
#define talus_grid_mesh_layout_h

#include <talus/base/box.h>
#include <talus/base/place_coordinates.h>
#include <talus/grid/lattice.h>
#include <talus/grid/periodicity.h>
#include <talus/grid/refinement_boxes.h>

#include <deal.II/base/parameter_acceptor.h>

#include <mpi.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// Names of the faces of the mesh, in the order of deal.II's boundary ids.
  extern const std::array<std::string, 6> face_names;

  /// Geometry of the mesh without cells: the box filled by the mesh, the trees
  /// of p4est, and the lattice of all possible cells of a level. Computed from
  /// the parameters before any cell exists; identical on all ranks.
  template <int dim>
  class MeshLayout : public dealii::ParameterAcceptor
  {
  public:
    using Lattice = talus::Lattice<dim>;

    /// Throw ExcUser if parameters contradict each other.
    void
    check() const;

    /// Easting, northing and height of x = y = z = 0 on the map, m.
    const dealii::Point<3> &
    origin() const
    {
      return origin_;
    }

    /// The box as the parameters have it, in the axes of the mesh.
    Box<dim>
    box_of_parameters() const;

    /// Edge of the smallest cells requested by the parameters, m.
    double
    cell_size_of_parameters() const;

    /// Box filled by the mesh.
    const Box<dim> &
    domain() const
    {
      return domain_;
    }

    /// Box of the mesh before upper faces moved outwards for the largest cells.
    const Box<dim> &
    domain_before_growth() const
    {
      return domain_before_growth_;
    }

    const Periodicity<dim> &
    periodicity() const
    {
      return periodicity_;
    }

    /// Sentence for the log if a face was moved, otherwise empty.
    const std::string &
    adjustment() const
    {
      return adjustment_;
    }

    /// Level of the cells of size h.
    unsigned int
    base_level() const
    {
      return base_level_;
    }

    /// Edge h of the cells at base_level(), m.
    double
    cell_size() const
    {
      return size_of_level(base_level_);
    }

    /// Edge of the smallest cells requested by the refinement boxes that
    /// overlap @p box, m.
    double
    finest_size_in(const Box<dim> &box) const;

    /// Edge of the cells of a level, m.
    double
    size_of_level(const unsigned int level) const
    {
      return tree_size_ / (1u << level);
    }

    /// Memory per rank before the mesh was created, bytes; see
    /// talus::memory_per_rank().
    double
    memory_per_rank() const
    {
      return memory_per_rank_;
    }

    /// Number of cells of @p level along each axis of the mesh.
    Lattice
    extent_of_lattice(unsigned int level) const;

    /// Position of the cell of @p level that contains @p x, m, or of the
    /// nearest cell if @p x lies outside of the mesh.
    Lattice
    lattice_place(const dealii::Point<dim> &x, unsigned int level) const;

    /// Lower corner of the cell of @p level at @p place, m.
    dealii::Point<dim>
    lower_corner_of(const Lattice &place, unsigned int level) const;

    /// Throw ExcUser if the ranks together cannot hold @p n_cells cells.
    void
    check_memory(double n_cells) const;

  protected:
    MeshLayout();

    /// Set up the box and the trees, see Mesh::create(). Return the number of
    /// trees along each axis. Collective.
    std::vector<unsigned int>
    lay_out(MPI_Comm                         communicator,
            const std::array<bool, 2 * dim> &may_move,
            bool                             grow,
            const std::array<bool, dim>     &periodic);

    bool
    has_refinement_boxes() const
    {
      return !boxes_.empty();
    }

    /// Whether the cell at @p place overlaps a refinement box that requests
    /// smaller cells.
    bool
    box_wants_finer(const Lattice &place, unsigned int level) const;

    /// Maximum number of cells on all @p n_ranks ranks together: p4est counts
    /// the cells of each rank in 32 bits, and deal.II numbers the nodes of all
    /// ranks together, by default in 32 bits.
    static double
    max_n_cells(double n_ranks);

  private:
    void
    check_lattice(unsigned int level) const;
    void
    fit_axis(unsigned int d, bool may_move, unsigned int factor);
    unsigned int
    level_of_trees(const std::array<bool, 2 * dim> &may_move, bool grow) const;

    // Parameters
    dealii::Point<dim> lower_corner_;
    dealii::Point<dim> upper_corner_;
    dealii::Point<3>   origin_;
    std::string        coordinates_        = "mesh";
    double             cell_size_          = 0.2;
    unsigned int       coarsest_level_     = 3;
    unsigned int       initial_refinement_ = 0;
    std::string        refinement_boxes_;

    Box<dim>                        domain_;
    Box<dim>                        domain_before_growth_;
    std::string                     adjustment_;
    std::array<unsigned int, dim>   n_cells_per_axis_;
    double                          tree_size_       = 0;
    unsigned int                    base_level_      = 0;
    bool                            grows_           = false;
    double                          memory_per_rank_ = 0; // bytes
    unsigned int                    n_ranks_         = 1;
    std::vector<RefinementBox<dim>> boxes_;
    Periodicity<dim>                periodicity_;
  };
} // namespace talus

#endif

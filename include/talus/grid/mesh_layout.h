// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_mesh_layout_h
#define talus_grid_mesh_layout_h

#include <talus/base/box.h>
#include <talus/base/place_coordinates.h>
#include <talus/grid/lattice.h>
#include <talus/grid/periodicity.h>
#include <talus/grid/refinement_boxes.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <string>
#include <vector>

namespace talus
{
  /// Names of the faces of the mesh in deal.II's order of boundary ids.
  extern const std::array<std::string, 6> face_names;

  /// Where cells may lie: the box that they fill, the trees of p4est that it
  /// consists of, and the lattice that the cells of a level would make if they
  /// filled it all. Follows from the parameters, before there is any cell, and
  /// is the same on all ranks.
  template <int dim>
  class MeshLayout : public dealii::ParameterAcceptor
  {
  public:
    using Lattice = talus::Lattice<dim>;

    /// Throw ExcUser if the parameters contradict each other.
    void
    check() const;

    /// Easting, northing and height of x = y = z = 0 on the map, m.
    const dealii::Point<3> &
    origin() const
    {
      return origin_;
    }

    /// The box that the mesh fills.
    const Box<dim> &
    domain() const
    {
      return domain_;
    }

    /// The box without what far cells were added for.
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

    /// Sentence for the log if a face had to be moved, else empty.
    const std::string &
    adjustment() const
    {
      return adjustment_;
    }

    /// The level of the cells of size h.
    unsigned int
    base_level() const
    {
      return base_level_;
    }

    /// Edge h of the cells where nothing asks for smaller ones, m.
    double
    cell_size() const
    {
      return size_of_level(base_level_);
    }

    /// Edge of the smallest cells that the parameters ask for anywhere in
    /// @p box, m.
    double
    finest_size_in(const Box<dim> &box) const;

    /// Edge of the cells of a level, m.
    double
    size_of_level(const unsigned int level) const
    {
      return tree_size_ / (1u << level);
    }

    /// See memory_per_rank(), before there was a mesh; bytes.
    double
    memory_per_rank() const
    {
      return memory_per_rank_;
    }

    /// Number of cells of this level along each axis of the mesh.
    Lattice
    extent_of_lattice(unsigned int level) const;

    /// Place of the cell of this level that contains @p x, moved onto the mesh.
    Lattice
    lattice_place(const dealii::Point<dim> &x, unsigned int level) const;

    /// Lower corner of the cell of this level at this place, m.
    dealii::Point<dim>
    lower_corner_of(const Lattice &place, unsigned int level) const;

  protected:
    MeshLayout();

    /// See Mesh::create(). Returns the number of trees along each axis.
    std::vector<unsigned int>
    lay_out(const std::array<bool, 2 * dim> &may_move,
            bool                             grow,
            const std::array<bool, dim>     &periodic);

    bool
    has_refinement_boxes() const
    {
      return !boxes_.empty();
    }

    /// Whether the cell at this place overlaps a refinement box that asks for
    /// smaller cells.
    bool
    box_wants_finer(const Lattice &place, unsigned int level) const;

    /// Throw ExcUser if the ranks together cannot hold so many cells.
    void
    check_memory(double n_cells) const;

  private:
    /// The box as the parameters have it, in the axes of the mesh.
    Box<dim>
    box_of_parameters() const;
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
    std::vector<RefinementBox<dim>> boxes_;
    Periodicity<dim>                periodicity_;
  };
} // namespace talus

#endif

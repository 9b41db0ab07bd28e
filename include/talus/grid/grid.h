// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_grid_h
#define talus_grid_grid_h

#include <talus/base/box.h>
#include <talus/grid/cell.h>
#include <talus/grid/periodicity.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/parameter_acceptor.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_q.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Names of the faces of the mesh in deal.II's order of boundary ids.
  extern const std::array<std::string, 6> face_names;

  template <int dim>
  class NodalExchange;

  /// The background grid: a p4est mesh of square (cubic) cells over a box, with
  /// Q1 elements and a flat cache of what the transfer needs.
  ///
  /// Cells are numbered in the order of p4est's space-filling curve, those this
  /// rank owns first, then its ghosts: an order that depends on the mesh alone
  /// and not on how it came about. Nodes are numbered as the owned cells, in
  /// this order, meet them; then come the ghosts, by owner. Ghosts are the
  /// nodes of the cells around the owned ones, and the masters of those among
  /// them that hang.
  template <int dim>
  class Grid : public dealii::ParameterAcceptor
  {
  public:
    explicit Grid(MPI_Comm communicator);

    /// Throw ExcUser if the parameters contradict each other.
    void
    check() const;

    using Lattice = talus::Lattice<dim>;

    /// Whether something in the cell at this place and level asks for smaller
    /// cells.
    using WantsFiner =
      std::function<bool(const Lattice &place, unsigned int level)>;

    /// Lay out the domain and its coarsest cells from the parameters.
    /// @p may_move tells for each face (see face_names) whether it may be moved
    /// outwards when the extent is not a multiple of the cell size, or, if
    /// cells are to @p grow far from soil, of the largest cells; along
    /// @p periodic axes the mesh repeats. Throws ExcUser if that cannot be done.
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
    /// mesh changed. Collective; prepare() must follow.
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

    /// Cells that this rank owns, also before prepare() counts them.
    unsigned int
    n_locally_owned_cells() const
    {
      return triangulation_.n_locally_owned_active_cells();
    }

    /// Share the cells out among the ranks by their weights; those of the cells
    /// this rank owns are given in the order of the cells. To be called before
    /// prepare(). Collective.
    void
    repartition(const std::vector<double> &weights);

    /// Rebuild degrees of freedom, constraints and the cell cache; to be called
    /// after each change of the mesh.
    void
    prepare();

    /// The box that the mesh fills.
    const Box<dim> &
    domain() const
    {
      return domain_;
    }

    /// The box without what far cells were added for in create().
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

    /// Edge h of the cells where nothing asks for smaller ones, m.
    double
    cell_size() const
    {
      return tree_size_ / (1u << base_level_);
    }

    /// The level of the cells of size h.
    unsigned int
    base_level() const
    {
      return base_level_;
    }

    /// Edge of the smallest cells, m.
    double
    finest_size() const
    {
      return finest_size_;
    }

    /// Sentence for the log if create() had to move a face, else empty.
    const std::string &
    adjustment() const
    {
      return adjustment_;
    }

    const Cells<dim> &
    cells() const
    {
      return cells_;
    }

    unsigned int
    n_owned_cells() const
    {
      return n_owned_cells_;
    }

    /// Active cells of all ranks.
    unsigned long
    n_global_cells() const
    {
      return triangulation_.n_global_active_cells();
    }

    /// Nodes this rank knows.
    unsigned int
    n_nodes() const
    {
      return owned_nodes_.n_elements() + ghost_nodes_.n_elements();
    }

    unsigned int
    n_owned_nodes() const
    {
      return owned_nodes_.n_elements();
    }

    /// Indices over all ranks of the nodes this rank owns, and of its ghosts.
    const dealii::IndexSet &
    owned_nodes() const
    {
      return owned_nodes_;
    }

    const dealii::IndexSet &
    ghost_nodes() const
    {
      return ghost_nodes_;
    }

    /// Nodes of this rank that are ghosts elsewhere, ascending.
    const std::vector<unsigned int> &
    interface_nodes() const
    {
      return interface_nodes_;
    }

    /// Rank that owns the cell.
    unsigned int
    owner_of_cell(const unsigned int c) const
    {
      return c < n_owned_cells_ ? triangulation_.locally_owned_subdomain()
                                : owner_of_ghost_[c - n_owned_cells_];
    }

    /// Ranks that own ghost cells of this one, ascending; this rank owns ghost
    /// cells of theirs.
    const std::vector<unsigned int> &
    neighbor_ranks() const
    {
      return neighbor_ranks_;
    }

    unsigned int
    level_of_cell(const unsigned int c) const
    {
      return level_of_cell_[c];
    }

    Lattice
    place_of_cell(unsigned int c) const;

    /// Place of the cell of this level that contains @p x, moved onto the mesh.
    Lattice
    lattice_place(const dealii::Point<dim> &x, unsigned int level) const;

    /// Number of cells of this level along each axis of the mesh.
    Lattice
    extent_of_lattice(unsigned int level) const;

    /// Whether the points of an owned cell may touch a node of a cell larger
    /// than h.
    bool
    is_near_larger_cell(const unsigned int c) const
    {
      return is_near_larger_cell_[c];
    }

    /// Name of a cell that all ranks know it by.
    unsigned long
    key_of_cell(unsigned int c) const;

    /// The inverse of key_of_cell(); invalid_unsigned_int if this rank does not
    /// know the cell.
    unsigned int
    cell_of_key(unsigned long key) const;

    /// The cells that share at least a corner with cell @p c, itself included,
    /// whatever their size; kept only for cells that are not uniform.
    const std::vector<unsigned int> &
    touching_cells(const unsigned int c) const
    {
      return touching_.at(c);
    }

    /// The cell that contains @p x, which is moved onto the mesh first where it
    /// lies outside; invalid_unsigned_int if this rank does not know that cell.
    unsigned int
    find_cell(dealii::Point<dim> x) const;

    /// Bit f is set if the node lies on face f of the mesh.
    unsigned char
    faces_of_node(const unsigned int node) const
    {
      return faces_of_node_[node];
    }

    /// Share of node @p node, owned by this rank, in face @p face of the mesh.
    const FaceShare &
    face_share(const unsigned int face, const unsigned int node) const
    {
      return face_shares_[face].at(node);
    }

    const std::vector<HangingNode> &
    hanging_nodes() const
    {
      return hanging_nodes_;
    }

    dealii::parallel::distributed::Triangulation<dim> &
    triangulation()
    {
      return triangulation_;
    }

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return dof_handler_;
    }

    /// Index among cells() of an active deal.II cell.
    unsigned int
    index_of(
      const typename dealii::Triangulation<dim>::cell_iterator &cell) const
    {
      return index_of_active_cell_[cell->active_cell_index()];
    }

    MPI_Comm
    communicator() const
    {
      return triangulation_.get_communicator();
    }

  private:
    void
    parse_refinement_boxes();
    void
    check_lattice(unsigned int level) const;
    bool
    box_wants_finer(const Lattice &place, unsigned int level) const;
    void
    fit_axis(unsigned int d, bool may_move, unsigned int factor);
    unsigned int
    level_of_trees(const std::array<bool, 2 * dim> &may_move, bool grow) const;
    unsigned int
    flag_cells(const WantsFiner &wants_finer);
    std::vector<typename dealii::DoFHandler<dim>::active_cell_iterator>
    cells_in_order() const;
    void
    number_nodes();
    void
    find_ghost_nodes();
    unsigned int
    local_node(dealii::types::global_dof_index node) const;
    void
    list_cells();
    void
    link_cell(unsigned int c);
    void
    fill_patch(unsigned int c);
    void
    find_touching_cells(unsigned int c);
    void
    mark_boundary_nodes(NodalExchange<dim> &exchange);
    std::vector<unsigned int>
    nodes_on_face(unsigned int c, unsigned int face) const;
    void
    find_larger_cells(NodalExchange<dim> &exchange);
    unsigned int
    cell_at(const Lattice &place, unsigned int level) const;

    // Parameters
    dealii::Point<dim> lower_corner_;
    dealii::Point<dim> upper_corner_;
    double             cell_size_          = 0.2;
    unsigned int       coarsest_level_     = 3;
    unsigned int       initial_refinement_ = 0;
    std::string        refinement_boxes_;

    Box<dim>                                          domain_;
    Box<dim>                                          domain_before_growth_;
    std::string                                       adjustment_;
    std::array<unsigned int, dim>                     n_cells_per_axis_;
    double                                            tree_size_   = 0;
    unsigned int                                      base_level_  = 0;
    double                                            finest_size_ = 0;
    std::vector<RefinementBox<dim>>                   boxes_;
    Periodicity<dim>                                  periodicity_;
    dealii::parallel::distributed::Triangulation<dim> triangulation_;
    dealii::FE_Q<dim>                                 fe_;
    dealii::DoFHandler<dim>                           dof_handler_;

    // The flat cache
    Cells<dim>                                      cells_;
    std::vector<unsigned int>                       level_of_cell_;
    std::vector<unsigned int>                       index_of_active_cell_;
    unsigned int                                    n_owned_cells_ = 0;
    std::vector<unsigned int>                       owner_of_ghost_;
    std::vector<unsigned int>                       neighbor_ranks_;
    dealii::IndexSet                                owned_nodes_;
    dealii::IndexSet                                ghost_nodes_;
    std::vector<unsigned int>                       interface_nodes_;
    std::unordered_map<unsigned long, unsigned int> cell_map_;
    std::unordered_map<unsigned int, std::vector<unsigned int>> touching_;
    std::vector<unsigned char>                                  faces_of_node_;
    std::vector<bool> is_near_larger_cell_;
    std::array<std::unordered_map<unsigned int, FaceShare>, 2 * dim>
                             face_shares_;
    std::vector<HangingNode> hanging_nodes_;
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
      twins_; ///< of nodes on upper periodic faces
  };
} // namespace talus

#endif

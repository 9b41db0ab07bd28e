// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_facets_h
#define talus_contact_facets_h

#include <talus/contact/nodal_gaps.h>
#include <talus/contact/obstacles.h>
#include <talus/grid/grid.h>

#include <array>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Part of the surface of an obstacle in one cell of the mesh, outside of all
  /// other obstacles. A facet is one contact point, at the centroid of the
  /// part. An obstacle has several facets in a cell if the surface has several
  /// directions there, see surfaces_by_direction().
  template <int dim>
  struct ContactFacet
  {
    static constexpr unsigned int n_nodes = power(2, dim);

    unsigned int                      cell;
    unsigned long                     key; ///< global key of the cell
    unsigned int                      obstacle;
    unsigned int                      number; ///< by direction of the normal
    std::array<unsigned int, n_nodes> node;   ///< nodes of the cell
    std::array<double, n_nodes>       shape_value; ///< at the centroid, by node
    dealii::Point<dim>                centroid;    ///< m
    dealii::Tensor<1, dim>            normal; ///< mean, out of the obstacle
    double                            area;   ///< m^(dim-1)
    /// Maximum distance of the surface from the plane through the centroid, m.
    double deviation;
    /// Whether the surface is within 1/200 of the cell size of the plane.
    bool   is_flat;
    double maximum_shear_stress; ///< Pa

    // Set for the current mesh
    double cell_size       = 0;     ///< m
    bool   cell_is_uniform = false; ///< see Cell::uniform
    bool   only_confines   = false; ///< whether no part of the contact

    /// Signed distance of @p x, m, from the plane of the facet, m; positive
    /// outside of the obstacle.
    double
    distance_from_plane(const dealii::Point<dim> &x) const
    {
      return (x - centroid) * normal;
    }
  };



  /// Surfaces of all obstacles, cut by the cells of the mesh: facets, nodes
  /// that touch facets, and open volume at the nodes. The result depends on
  /// mesh, partition and positions of the obstacles, not on the soil.
  template <int dim>
  class Facets
  {
  public:
    /// Cut all cells. Call after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid, const Obstacles<dim> &obstacles);

    /// Cut the cells again which a moving obstacle has left, cuts or enters.
    /// Call after obstacles have moved.
    void
    update(const Grid<dim> &grid, const Obstacles<dim> &obstacles);

    /// Return the facets in the owned cells, sorted by cell, then by obstacle.
    const std::vector<ContactFacet<dim>> &
    owned() const
    {
      return owned_;
    }

    /// Return the facets in the ghost cells, sorted by cell, then by obstacle.
    const std::vector<ContactFacet<dim>> &
    ghosts() const
    {
      return ghosts_;
    }

    /// Call action(facet) for all surfaces in cell @p c: for the facets, for
    /// whole surfaces partly covered by another obstacle, and for surfaces on a
    /// face of a cell inside an obstacle.
    template <typename Action>
    void
    for_each_in_cell(const unsigned int c, const Action &action) const
    {
      for (unsigned int i = in_cell_[c].begin; i < in_cell_[c].end; ++i)
        action(surfaces_[i]);
    }

    /// Whether cell @p c contains a surface, see for_each_in_cell().
    bool
    is_cut(const unsigned int c) const
    {
      return in_cell_[c].begin != in_cell_[c].end;
    }

    /// Return the facet in cell @p c if it is the only surface there; nullptr
    /// otherwise.
    const ContactFacet<dim> *
    only_surface(const unsigned int c) const
    {
      const SurfacesInCell &range = in_cell_[c];
      return range.end - range.begin == 1 &&
                 !surfaces_[range.begin].only_confines
               ? &surfaces_[range.begin]
               : nullptr;
    }

    /// Return only_surface() if flat; nullptr otherwise.
    const ContactFacet<dim> *
    flat_facet(const unsigned int c) const
    {
      const ContactFacet<dim> *const facet = only_surface(c);
      return facet && facet->is_flat ? facet : nullptr;
    }

    /// Obstacles, ascending, which contain the whole of cell @p c and so have
    /// no facet there. Call only if obstacles exist.
    const std::vector<unsigned int> &
    containing(const unsigned int c) const
    {
      static const std::vector<unsigned int> none;
      return in_cell_[c].is_contained ? section_at_[c]->containing : none;
    }

    /// Cells which share a corner with cell @p c, including @p c. Cell @p c,
    /// owned or ghost, must have a facet.
    const std::vector<unsigned int> &
    touching_cells(const unsigned int c) const
    {
      return cut_cell_at_[c]->touching;
    }

    /// Return the owned nodes of cells with a facet.
    const std::vector<unsigned int> &
    owned_nodes() const
    {
      return owned_nodes_;
    }

    /// Return all nodes of cells with a facet, also ghosts.
    const std::vector<unsigned int> &
    nodes() const
    {
      return nodes_;
    }

    /// Return owned_nodes() on faces of the mesh, where walls may be.
    const std::vector<unsigned int> &
    owned_nodes_on_faces() const
    {
      return owned_nodes_on_faces_;
    }

    /// Return nodes() on faces of the mesh.
    const std::vector<unsigned int> &
    nodes_on_faces() const
    {
      return nodes_on_faces_;
    }

    /// Whether an obstacle acts on soil at @p node.
    bool
    is_contact_node(const unsigned int node) const
    {
      return is_contact_node_[node];
    }

    /// Return is_contact_node() of all nodes, 1 or 0.
    const std::vector<unsigned char> &
    contact_nodes() const
    {
      return is_contact_node_;
    }

    /// Return all pairs of a contact node and an obstacle acting on the node,
    /// ghosts included. For nodes_inside() only the nearest obstacle is listed.
    const std::vector<NodeAndSurface> &
    nodes_and_obstacles() const
    {
      return nodes_and_obstacles_;
    }

    /// Number of facets, of all obstacles, in the cells around an owned node.
    unsigned int
    n_facets(const unsigned int node) const
    {
      return n_facets_[node];
    }

    /// Integral of the shape function of an owned node outside of all
    /// obstacles, m^dim; 0 if the node touches no facet.
    double
    open_volume(const unsigned int node) const
    {
      return open_volume_[node];
    }

    /// Node inside an obstacle, near the surface, which touches no facet.
    struct NodeInside
    {
      unsigned int       node;
      dealii::Point<dim> place; ///< m
      unsigned int       obstacle;
    };

    /// Return the owned nodes inside obstacles which touch no facet.
    const std::vector<NodeInside> &
    nodes_inside() const
    {
      return nodes_inside_;
    }

    /// Whether points in @p cell may reach a node of a cell with a facet.
    bool
    is_near(const unsigned int cell) const
    {
      return is_near_[cell];
    }

    /// Return a number for each cell: 2 for owned cells with a facet, 1 for
    /// other owned cells with is_near(), 0 for all others.
    const std::vector<unsigned char> &
    nearness_of_cells() const
    {
      return is_near_;
    }

  private:
    /// Result of cutting a cell, independent of the numbers of cell and nodes.
    struct Section
    {
      /// Distance of the centre of the cell from the nearest obstacle, m; the
      /// largest number if none is near the cell.
      double                         distance;
      std::vector<ContactFacet<dim>> facets;     ///< in contact with soil
      std::vector<ContactFacet<dim>> hidden;     ///< only confine points
      std::vector<unsigned int>      containing; ///< obstacles
      std::array<double, ContactFacet<dim>::n_nodes> open_volume{};
    };

    /// Cell with surfaces, with the current numbers of cells and nodes.
    struct CutCell
    {
      std::vector<ContactFacet<dim>>                 facets;
      std::vector<ContactFacet<dim>>                 hidden;
      std::array<double, ContactFacet<dim>::n_nodes> open_volume;
      std::vector<unsigned int> touching; ///< cells within one cell
      /// Cells within two cells. Empty if they follow from the neighbours of
      /// the touching cells.
      std::vector<unsigned int> near;
    };

    /// Range of a cell in surfaces_, and whether an obstacle contains the whole
    /// cell.
    struct SurfacesInCell
    {
      unsigned int begin = 0, end = 0;
      bool         is_contained = false;
    };

    Section
    find_section(const Grid<dim>      &grid,
                 const Obstacles<dim> &obstacles,
                 unsigned int          c) const;
    void
    keep_sections(const Grid<dim> &grid, const Obstacles<dim> &obstacles);
    void
    cut(const Grid<dim> &grid, unsigned int c);
    void
    find_facets(const Grid<dim>                        &grid,
                const Obstacles<dim>                   &obstacles,
                const typename Obstacles<dim>::Numbers &near,
                unsigned int                            c,
                Section                                &section) const;
    void
    clear_sums();
    void
    collect(const Grid<dim> &grid, const Obstacles<dim> &obstacles);
    void
    list_surfaces();
    void
    mark_near(const Grid<dim> &grid);
    void
    add_open_volume(const Grid<dim> &grid, unsigned int c);

    void
    find_nodes_inside(const Grid<dim>      &grid,
                      const Obstacles<dim> &obstacles,
                      unsigned int          c);

    std::unordered_map<unsigned long, Section> sections_;  ///< by key of cell
    std::map<unsigned int, CutCell>            cut_cells_; ///< with ghosts
    std::vector<const CutCell *> cut_cell_at_; ///< by cell, for fast access
    std::vector<const Section *> section_at_;  ///< by cell
    /// Facets and hidden surfaces of all cut cells, sorted by cell: the step
    /// needs them without jumps in memory.
    std::vector<ContactFacet<dim>> surfaces_;
    std::vector<SurfacesInCell>    in_cell_; ///< by cell
    std::set<unsigned int>    cells_inside_; ///< centre inside, near surface
    std::vector<unsigned int> listed_near_;
    std::vector<ContactFacet<dim>> owned_, ghosts_;
    std::vector<unsigned int>      owned_nodes_, nodes_;
    std::vector<unsigned int>      owned_nodes_on_faces_, nodes_on_faces_;
    std::vector<NodeAndSurface>    nodes_and_obstacles_;
    std::vector<NodeInside>        nodes_inside_;
    std::vector<unsigned char>     is_contact_node_; ///< by node
    std::vector<unsigned int>      n_facets_;        ///< by node
    std::vector<double>            open_volume_;     ///< by node
    std::vector<unsigned char>     is_near_;         ///< by cell
  };
} // namespace talus

#endif

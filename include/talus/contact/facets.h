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
  /// other obstacles. It is one contact point, at its centroid. An obstacle has
  /// several facets in a cell where its surface has several directions, see
  /// surfaces_by_direction().
  template <int dim>
  struct ContactFacet
  {
    static constexpr unsigned int n_nodes = power(2, dim);

    unsigned int                      cell;
    unsigned long                     key; ///< of the cell, on all ranks
    unsigned int                      obstacle;
    unsigned int                      number; ///< of this obstacle in the cell
    std::array<unsigned int, n_nodes> node;   ///< of the cell
    std::array<double, n_nodes>       shape_value; ///< of these at the centroid
    dealii::Point<dim>                centroid;    ///< m
    dealii::Tensor<1, dim>            normal; ///< out of the obstacle, mean
    double                            area;   ///< m^(dim-1)
    /// How far the surface may be from the plane through the centroid, m.
    double deviation;
    double maximum_shear_stress; ///< Pa
  };



  /// The surfaces of all obstacles as the mesh sees them: their facets, and how
  /// much room they leave at the nodes. It depends on mesh, partition and
  /// places of the obstacles only.
  template <int dim>
  class Facets
  {
  public:
    /// Cut all cells; after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid, const Obstacles<dim> &obstacles);

    /// Cut those cells anew that a moving obstacle is in, or was.
    void
    update(const Grid<dim> &grid, const Obstacles<dim> &obstacles);

    /// Those in the cells that this rank owns, in the order of the cells, and in
    /// a cell in that of the obstacles.
    const std::vector<ContactFacet<dim>> &
    owned() const
    {
      return owned_;
    }

    /// Facets in the ghost cells, in the same order.
    const std::vector<ContactFacet<dim>> &
    ghosts() const
    {
      return ghosts_;
    }

    /// Call action(facet) for all surfaces in cell @p c of this rank: for the
    /// facets of owned(), for whole surfaces of which another obstacle covers a
    /// part, and for surfaces on the faces of a cell inside.
    template <typename Action>
    void
    for_each_in_cell(const unsigned int c, const Action &action) const
    {
      if (const CutCell *const cut_cell = cut_cell_at_[c])
        for (const auto *facets : {&cut_cell->facets, &cut_cell->hidden})
          for (const ContactFacet<dim> &facet : *facets)
            action(facet);
    }

    /// Obstacles that contain the whole of cell @p c of this rank, and so have no
    /// facet there, in ascending order.
    const std::vector<unsigned int> &
    containing(const unsigned int c) const
    {
      return section_at_[c]->containing;
    }

    /// Cells that share a corner with cell @p c, which has a facet and may be a
    /// ghost; cell @p c itself is one of them.
    const std::vector<unsigned int> &
    touching_cells(const unsigned int c) const
    {
      return cut_cell_at_[c]->touching;
    }

    /// Nodes that touch a facet: those this rank owns, and all it knows.
    const std::vector<unsigned int> &
    owned_nodes() const
    {
      return owned_nodes_;
    }

    const std::vector<unsigned int> &
    nodes() const
    {
      return nodes_;
    }

    /// Those of them on the faces of the mesh, where walls may be.
    const std::vector<unsigned int> &
    owned_nodes_on_faces() const
    {
      return owned_nodes_on_faces_;
    }

    const std::vector<unsigned int> &
    nodes_on_faces() const
    {
      return nodes_on_faces_;
    }

    /// Whether soil at a node feels an obstacle.
    bool
    is_contact_node(const unsigned int node) const
    {
      return is_contact_node_[node];
    }

    /// That of all nodes, 1 or 0.
    const std::vector<unsigned char> &
    contact_nodes() const
    {
      return is_contact_node_;
    }

    /// Nodes for which it is 1, with the obstacles that they feel; ghosts, too.
    const std::vector<NodeAndSurface> &
    nodes_and_obstacles() const
    {
      return nodes_and_obstacles_;
    }

    /// Facets of all obstacles in the cells around a node this rank owns.
    unsigned int
    n_facets(const unsigned int node) const
    {
      return n_facets_[node];
    }

    /// Integral of the shape function of such a node over what the obstacles
    /// leave open, m^dim.
    double
    open_volume(const unsigned int node) const
    {
      return open_volume_[node];
    }

    /// Node inside an obstacle, beside its surface, that touches no facet.
    struct NodeInside
    {
      unsigned int       node;
      dealii::Point<dim> place; ///< m
      unsigned int       obstacle;
    };

    /// Those that this rank owns.
    const std::vector<NodeInside> &
    nodes_inside() const
    {
      return nodes_inside_;
    }

    /// Whether points in this cell may touch a node of the two lists.
    bool
    is_near(const unsigned int cell) const
    {
      return is_near_[cell];
    }

    /// Of all cells: 0 for those that are not near, 2 for those with a facet, 3
    /// for those with surfaces that take no part in the contact, 1 for the
    /// others.
    const std::vector<unsigned char> &
    nearness_of_cells() const
    {
      return is_near_;
    }

  private:
    /// What the surfaces make of a cell, whatever the numbers of its nodes.
    struct Section
    {
      /// Distance of the centre of the cell from the nearest obstacle, m; the
      /// largest number if none is near the cell.
      double                         distance;
      std::vector<ContactFacet<dim>> facets;     ///< where soil may be
      std::vector<ContactFacet<dim>> hidden;     ///< partly or wholly covered
      std::vector<unsigned int>      containing; ///< obstacles
      std::array<double, ContactFacet<dim>::n_nodes> open_volume{};
    };

    /// The same in the mesh.
    struct CutCell
    {
      std::vector<ContactFacet<dim>>                 facets;
      std::vector<ContactFacet<dim>>                 hidden;
      std::array<double, ContactFacet<dim>::n_nodes> open_volume;
      std::vector<unsigned int> touching; ///< those that share a node with it
      std::vector<unsigned int> near; ///< owned ones that touch one of these
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
    add_open_volume(const Grid<dim> &grid, unsigned int c);

    void
    find_nodes_inside(const Grid<dim>      &grid,
                      const Obstacles<dim> &obstacles,
                      unsigned int          c);

    std::unordered_map<unsigned long, Section> sections_;  ///< by key of cell
    std::map<unsigned int, CutCell>            cut_cells_; ///< ghosts, too
    std::vector<const CutCell *> cut_cell_at_;  ///< by cell, for who asks often
    std::vector<const Section *> section_at_;   ///< by cell
    std::set<unsigned int>       cells_inside_; ///< beside surfaces
    std::vector<unsigned int>    listed_near_;
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

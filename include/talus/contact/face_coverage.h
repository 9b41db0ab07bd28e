// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_face_coverage_h
#define talus_contact_face_coverage_h

#include <talus/contact/contact_area.h>
#include <talus/grid/nodal_exchange.h>
#include <talus/state/state.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// Area of soil on faces of the mesh: the cross-sections of the boxes near a
  /// face, distributed to the nodes of the face by the mean shape functions of
  /// the boxes along the face. In contrast to an area from the volume fraction
  /// of the cells, the area does not shrink with the thickness of a layer
  /// thinner than a cell.
  template <int dim>
  class FaceCoverage
  {
  public:
    /// Collect cells and nodes at @p faces (bit f for face f of the mesh). Call
    /// after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid, unsigned char faces);

    /// Compute the areas from points and volumes at the nodes. Collective.
    void
    find(const State<dim> &state);

    /// Share of @p face in contact with soil [-] around an owned node on the
    /// face, which stands for the area @p whole, m^(dim-1), of the face and has
    /// the volume fraction @p f of soil [-].
    double
    share(const unsigned int face,
          const unsigned int node,
          const double       whole,
          const double       f) const
    {
      const double covered = areas_[n_faces_ * node + slot_[face]];
      return f > 0 ? share_in_contact(std::min(1., covered / whole), f) : 0.;
    }

    /// Call action(face, node) for the owned nodes on the faces.
    template <typename Action>
    void
    for_each_node(const Action &action) const
    {
      for (const NodeAtFace &at : nodes_)
        action(at.face, at.node);
    }

  private:
    struct CellAtFace
    {
      unsigned int cell;
      unsigned int face;
      unsigned int row; ///< row of the patch on the face
    };

    struct NodeAtFace
    {
      unsigned int node;
      unsigned int face;
      double       volume_of_cells; ///< integral of the shape function, m^dim
    };

    bool
    is_covered_anyway(const Grid<dim> &grid, const CellAtFace &at) const;
    void
    add_cell(const State<dim>  &state,
             const CellAtFace  &at,
             const unsigned int begin,
             const unsigned int end);
    void
    add_to_patch(const State<dim> &state,
                 const CellAtFace &at,
                 unsigned int      p,
                 double            area);
    void
    add_by_weights(const State<dim> &state,
                   const CellAtFace &at,
                   unsigned int      p,
                   double            area);
    void
    give_to_masters(const Grid<dim> &grid);
    double &
    area(const unsigned int face, const unsigned int node)
    {
      return areas_[n_faces_ * node + slot_[face]];
    }

    unsigned int                      n_faces_ = 0;
    std::array<unsigned int, 2 * dim> slot_{};  ///< index of a face
    std::vector<CellAtFace>           cells_;   ///< sorted by cell
    std::vector<NodeAtFace>           nodes_;   ///< at the faces, owned
    std::vector<unsigned char>        is_full_; ///< bit f for face f, by node
    std::vector<double>               areas_;   ///< by node and slot
    NodalExchange<dim>                exchange_;
    std::vector<NodeWeight<dim>>      weights_; ///< weights of a point
  };
} // namespace talus

#endif

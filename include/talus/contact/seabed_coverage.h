// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_seabed_coverage_h
#define talus_contact_seabed_coverage_h

#include <talus/boundaries/boundaries.h>
#include <talus/interaction/nodal_interaction.h>
#include <talus/state/state.h>
#include <talus/transfer/weights.h>

#include <vector>

namespace talus
{
  /// Area of soil on the seabed faces of the mesh: the cross-sections of the
  /// boxes near a face, distributed to the nodes of the face by the mean shape
  /// functions of the boxes along the face. In contrast to an area from the
  /// volume fraction of the cells, the area does not shrink with the thickness
  /// of a layer thinner than a cell.
  template <int dim>
  class SeabedCoverage : public NodalInteraction<dim>
  {
  public:
    /// The friction of @p boundaries will use the areas.
    explicit SeabedCoverage(Boundaries<dim> &boundaries);

    /// Collect cells and nodes at the seabed. Call after each change of the
    /// mesh or its partition.
    void
    prepare(const Grid<dim> &grid) override;

    /// Compute the areas from points and volumes at the nodes. Collective.
    void
    find(const State<dim> &state);

    void
    begin_step(State<dim> &state) override
    {
      find(state);
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

    Boundaries<dim>                  &boundaries_;
    unsigned int                      n_faces_ = 0; ///< number of seabeds
    std::array<unsigned int, 2 * dim> slot_{};      ///< index of a seabed
    std::vector<CellAtFace>           cells_;       ///< sorted by cell
    std::vector<NodeAtFace>           nodes_;       ///< at seabeds, owned
    std::vector<unsigned char>        is_full_; ///< bit f for face f, by node
    std::vector<double>               areas_;   ///< by node and slot
    NodalExchange<dim>                exchange_;
    std::vector<NodeWeight<dim>>      weights_; ///< weights of a point
  };
} // namespace talus

#endif

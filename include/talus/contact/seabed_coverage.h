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
  /// Area of the seabed faces of the mesh that soil covers: the sections of the
  /// boxes near a face, shared among its nodes by the mean shape functions of the
  /// boxes along the face. Unlike the volume fraction of the cells at the face it
  /// does not shrink with the thickness of a layer thinner than a cell.
  template <int dim>
  class SeabedCoverage : public NodalInteraction<dim>
  {
  public:
    /// @p boundaries gets the areas for its friction.
    explicit SeabedCoverage(Boundaries<dim> &boundaries);

    /// Find cells and nodes at the seabed, after each change of the mesh or its
    /// partition.
    void
    prepare(const Grid<dim> &grid) override;

    /// Find the areas, when the volumes at the nodes are known. Collective.
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
      unsigned int row; ///< of the patch, across the face, that lies on it
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
    unsigned int                      n_faces_ = 0; ///< that are a seabed
    std::array<unsigned int, 2 * dim> slot_{};      ///< of a face among them
    std::vector<CellAtFace>           cells_;       ///< sorted by cell
    std::vector<unsigned int>         nodes_;       ///< at seabeds, owned
    std::vector<unsigned char>        is_full_; ///< bit f for face f, by node
    std::vector<double>               areas_;   ///< by node and slot
    NodalExchange<dim>                exchange_;
    std::vector<NodeWeight<dim>>      weights_; ///< of a point
  };
} // namespace talus

#endif

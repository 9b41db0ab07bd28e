// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_seabed_gaps_h
#define talus_contact_seabed_gaps_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/interaction/nodal_interaction.h>

#include <vector>

namespace talus
{
  /// Clearance between soil and the seabed faces of the mesh, for seabeds with
  /// a gap.
  template <int dim>
  class SeabedGaps : public NodalInteraction<dim>
  {
  public:
    /// @p boundaries will use the clearances.
    explicit SeabedGaps(Boundaries<dim> &boundaries);

    /// Call after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid) override;

    /// Compute the clearances in this step. Collective.
    void
    find(const State<dim> &state);

    void
    begin_step(State<dim> &state) override
    {
      find(state);
    }

  private:
    Boundaries<dim>            &boundaries_;
    NodalGaps<dim>              gaps_;
    std::vector<unsigned int>   surface_of_face_;
    std::vector<NodeAndSurface> pairs_;         ///< with ghosts
    std::vector<unsigned char>  nearness_;      ///< by cell
    double                      cell_size_ = 0; ///< minimum, m
  };
} // namespace talus

#endif

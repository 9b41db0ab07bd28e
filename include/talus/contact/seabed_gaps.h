// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_seabed_gaps_h
#define talus_contact_seabed_gaps_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/interaction/nodal_interaction.h>

#include <vector>

namespace talus
{
  /// How far soil is from those faces of the mesh that are a seabed with a gap.
  template <int dim>
  class SeabedGaps : public NodalInteraction<dim>
  {
  public:
    /// @p boundaries will ask here.
    explicit SeabedGaps(Boundaries<dim> &boundaries);

    /// To be called after each change of the mesh or its partition.
    void
    prepare(const Grid<dim> &grid) override;

    /// Find the gaps of this step. Collective.
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
    std::vector<NodeAndSurface> pairs_;         ///< ghosts, too
    std::vector<unsigned char>  nearness_;      ///< by cell
    double                      cell_size_ = 0; ///< of the smallest, m
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_face_gaps_h
#define talus_contact_face_gaps_h

#include <talus/contact/nodal_gaps.h>

#include <vector>

namespace talus
{
  /// Clearance between soil and faces of the mesh.
  template <int dim>
  class FaceGaps
  {
  public:
    /// Set the faces, bit f for face f of the mesh. Call after each change of
    /// the mesh or its partition.
    void
    prepare(const Grid<dim> &grid, unsigned char faces);

    /// Compute the clearances in this step. Collective.
    void
    find(const State<dim> &state);

    /// Clearance between the soil at a node and @p face, m: distance in excess
    /// of the contact distance; 0 for faces not given to prepare().
    double
    room(const unsigned int face, const unsigned int node) const
    {
      return (faces_ & (1u << face))
               ? gaps_.room(node, surface_of_face_[face], cell_size_)
               : 0.;
    }

  private:
    unsigned char               faces_ = 0;
    NodalGaps<dim>              gaps_;
    std::array<unsigned int, 6> surface_of_face_{};
    std::vector<NodeAndSurface> pairs_;         ///< with ghosts
    std::vector<unsigned char>  nearness_;      ///< by cell
    double                      cell_size_ = 0; ///< minimum, m
  };
} // namespace talus

#endif

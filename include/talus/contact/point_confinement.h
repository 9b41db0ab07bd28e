// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_point_confinement_h
#define talus_contact_point_confinement_h

#include <talus/contact/facets.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Lets no box of a material point go into an obstacle.
  ///
  /// Contact is a constraint on the velocity of the nodes, one for each facet.
  /// In a layer thinner than a cell that is the velocity of the nodes with most
  /// soil, and points at the surface move with another one: while the layer
  /// spreads, they sink by 0.2 to 0.3 cells per unit of strain. So of the motion
  /// of a point whose box has come to the surface with its lower side the part
  /// that leads further in is left out. Velocities, stress and all balances
  /// stay as they are. To push points out that are inside already would give
  /// neighbours a jerk. A point is held by the surfaces in its own cell: where a
  /// surface lies just below a face of the mesh, a box sinks until its centre is
  /// in the cell of the surface.
  template <int dim>
  class PointConfinement
  {
  public:
    PointConfinement(const Obstacles<dim> &obstacles, const Facets<dim> &facets)
      : obstacles_(obstacles)
      , facets_(facets)
    {}

    /// Remember where the points of @p batch are that may come to a surface
    /// within a step, before they move.
    void
    note(const State<dim> &state, const Batch &batch);

    /// Take back what led the noted points further into obstacles, and tell the
    /// workspace which these are: they may be in another cell than they were
    /// seen in.
    void
    confine(State<dim> &state);

  private:
    struct Candidate
    {
      unsigned int             point;
      unsigned int             obstacle;
      const ContactFacet<dim> *facet; ///< nullptr if the obstacle contains the
                                      ///< whole cell
      dealii::Point<dim>     place;   ///< before it moved, m
      dealii::Tensor<1, dim> half;    ///< half lengths of its box, m
    };

    void
    note_contained(const State<dim> &state, const Segment &segment);

    bool
    confine(const Candidate    &candidate,
            double              time,
            double              dt,
            dealii::Point<dim> &x) const;

    const Obstacles<dim>  &obstacles_;
    const Facets<dim>     &facets_;
    std::vector<Candidate> candidates_; ///< one for each facet
  };
} // namespace talus

#endif

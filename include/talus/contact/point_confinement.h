// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_point_confinement_h
#define talus_contact_point_confinement_h

#include <talus/contact/facets.h>
#include <talus/contact/surface_tables.h>
#include <talus/state/state.h>

#include <utility>
#include <vector>

namespace talus
{
  /// Keeps the boxes of material points from moving into obstacles.
  ///
  /// Contact constrains velocities of nodes, once per facet. In a layer thinner
  /// than a cell a facet sees the velocity of the nodes with most soil, and
  /// points at the surface move differently: while the layer spreads, the
  /// points sink by 0.2 to 0.3 cells per unit of strain. If the lower side of a
  /// box is below the surface, PointConfinement cancels the part of the motion
  /// of the point that leads further into the obstacle. Velocities, stress and
  /// all balances stay unchanged. Points already inside are not pushed out:
  /// this would disturb neighbours. Only surfaces in the cell of a point hold
  /// the point: if a surface lies just below a face of the mesh, a box sinks
  /// until the centre is in the cell of the surface.
  template <int dim>
  class PointConfinement
  {
  public:
    PointConfinement(const Obstacles<dim> &obstacles, const Facets<dim> &facets)
      : obstacles_(obstacles)
      , facets_(facets)
      , tables_(obstacles)
    {}

    /// Store the positions of the points of @p batch which may reach a surface
    /// within the step. Call before the points move.
    void
    note(const State<dim> &state, const Batch &batch);

    /// Cancel the motion of the points of the last note() further into
    /// obstacles. Call after points and obstacles have moved. Adds corrected
    /// points to StepWorkspace::points_out_of_cell().
    void
    confine(State<dim> &state);

  private:
    struct Candidate
    {
      unsigned int             point;
      unsigned int             obstacle;
      const ContactFacet<dim> *facet; ///< nullptr if the obstacle contains the
                                      ///< whole cell
      const SurfaceTable<dim> *table; ///< nullptr: exact distances
      dealii::Point<dim>       place; ///< before the motion, m
      dealii::Tensor<1, dim>   half;  ///< half lengths of the box, m
    };

    void
    note_contained(const State<dim> &state, const Segment &segment);
    void
    note_at_facet(const State<dim>        &state,
                  const Segment           &segment,
                  const ContactFacet<dim> &facet);
    std::pair<double, dealii::Tensor<1, dim>>
    distance_and_normal(const Candidate              &candidate,
                        const dealii::Point<dim>     &x,
                        const dealii::Tensor<1, dim> &drift) const;

    bool
    confine(const Candidate    &candidate,
            double              time,
            double              dt,
            dealii::Point<dim> &x) const;

    const Obstacles<dim>      &obstacles_;
    const Facets<dim>         &facets_;
    std::vector<Candidate>     candidates_; ///< pairs of point and surface
    std::vector<unsigned char> is_moved_;   ///< by point, used in confine()
    SurfaceTables<dim>         tables_;
  };
} // namespace talus

#endif

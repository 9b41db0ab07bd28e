// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_soil_at_places_h
#define talus_contact_soil_at_places_h

#include <talus/contact/contact_area.h>
#include <talus/contact/face_coverage.h>
#include <talus/contact/face_gaps.h>
#include <talus/contact/face_nodes.h>
#include <talus/contact/facet_coverage.h>
#include <talus/contact/facets.h>
#include <talus/contact/nodal_gaps.h>
#include <talus/contact/nodal_pore_pressure.h>
#include <talus/contact/surface_tables.h>
#include <talus/grid/nodal_exchange.h>

#include <vector>

namespace talus
{
  /// Soil at the surfaces of seabed and obstacles in the current step, from the
  /// boxes of the points and the volumes at the nodes: the share of a surface
  /// in contact, the gap between soil and surface, and the volume fraction of
  /// soil outside of obstacles. Friction, static stages and water all ask here.
  template <int dim>
  class SoilAtPlaces
  {
  public:
    SoilAtPlaces(const Obstacles<dim> &obstacles, const Facets<dim> &facets)
      : obstacles_(obstacles)
      , facets_(facets)
    {}

    /// Call after each change of the mesh or its partition, after
    /// Facets::prepare(). @p faces: seabeds, bit f for face f of the mesh;
    /// @p have_gap: whether gap() at their nodes may be positive. Collective.
    void
    prepare(const Grid<dim> &grid, unsigned char faces, bool have_gap);

    /// Examine the soil. Call after the transfer to the grid and after
    /// obstacles have moved. Collective.
    void
    find(const State<dim> &state);

    /// Volume of the soil at a node of a facet divided by the volume outside of
    /// obstacles [-], at most 1; also for ghosts.
    double
    volume_fraction(const unsigned int node) const
    {
      return gaps_.volume_fraction(node);
    }

    /// Mean of volume_fraction() at facet @p facet of Facets::owned() [-].
    double
    fraction(const unsigned int facet) const
    {
      return fractions_[facet];
    }

    /// Share of facet @p facet of Facets::owned() in contact with soil [-].
    double
    share(const unsigned int facet) const
    {
      return fractions_[facet] > 0
               ? share_in_contact(coverage_[facet], fractions_[facet])
               : 0.;
    }

    /// Area of a seabed face in contact with soil at a node, m^(dim-1).
    double
    area_in_contact(const NodalFields<dim> &nodes,
                    const FaceNode<dim>    &at) const
    {
      const double f = std::min(1., nodes.volume(at.node) / at.volume);
      return at.area * at_faces_.share(at.face, at.node, at.area, f);
    }

    /// Excess pore pressure of the soil at a node on a seabed face, Pa.
    double
    pore_pressure(const FaceNode<dim> &at) const
    {
      const double one = 1.;
      return pore_pressure_.at(
        &at.node, &one, 1, at.x, at.normal(), at.cell_size());
    }

    /// Excess pore pressure of the soil at a facet, Pa; @p share of the nodes
    /// [-].
    double
    pore_pressure(
      const ContactFacet<dim>                              &facet,
      const std::array<double, ContactFacet<dim>::n_nodes> &share) const
    {
      return pore_pressure_.at(facet.node.data(),
                               share.data(),
                               share.size(),
                               facet.centroid,
                               facet.normal,
                               facet.cell_size);
    }

    /// Clearance between the soil at a node and a seabed face, m: distance in
    /// excess of the contact distance.
    double
    gap(const FaceNode<dim> &at) const
    {
      return face_gaps_.room(at.face, at.node);
    }

    /// Clearance between the soil at a node and an obstacle, m: distance in
    /// excess of the contact distance in cells of @p cell_size, m.
    double
    gap(const unsigned int node,
        const unsigned int obstacle,
        const double       cell_size) const
    {
      return gaps_.room(node, obstacle, cell_size);
    }

  private:
    void
    prepare_gaps(const Grid<dim> &grid, std::vector<unsigned int> slots);
    std::vector<typename NodalGaps<dim>::Surface>
    surfaces() const;
    std::vector<unsigned int>
    slots(const Grid<dim> &grid) const;
    std::vector<unsigned char>
    nodes_of_places(const Grid<dim> &grid) const;
    void
    find_gaps(const State<dim> &state);
    void
    find_fractions(const std::vector<ContactFacet<dim>> &facets,
                   std::vector<double>                  &fractions) const;

    const Obstacles<dim>  &obstacles_;
    const Facets<dim>     &facets_;
    FaceCoverage<dim>      at_faces_;
    FaceGaps<dim>          face_gaps_;
    SurfaceTables<dim>     tables_{obstacles_};
    NodalGaps<dim>         gaps_; ///< surfaces: the obstacles
    FacetCoverage<dim>     coverage_{obstacles_, facets_};
    NodalPorePressure<dim> pore_pressure_;
    unsigned char          faces_ = 0;           ///< seabeds, bit f for face f
    std::vector<double>    fractions_;           ///< by owned facet [-]
    std::vector<double>    fractions_of_ghosts_; ///< by ghost facet [-]
  };
} // namespace talus

#endif

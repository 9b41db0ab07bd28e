// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_contact_soil_on_bed_h
#define talus_tests_unit_contact_soil_on_bed_h

#include <talus/contact/contact.h>

#include "equilibrium_setup.h"

namespace
{
  /// Soil of 1500 kg/m^3 in a mesh with cells of 1 m, over the level surface
  /// y = 2 m of the obstacle "bed", which lies on faces of the mesh, or over
  /// another surface.
  template <int dim>
  struct SoilOnBed : Statics<dim>
  {
    using Statics<dim>::grid;
    using Statics<dim>::nodes;
    using Statics<dim>::obstacles;
    using Statics<dim>::points;

    /// Half a cell of soil above a facet, kg: effective mass of the facet.
    static constexpr double half_cell = 0.5 * Statics<dim>::density;

    /// @param bed entries of the obstacle
    /// @param boundaries entries of section Boundaries
    explicit SoilOnBed(const std::string &bed        = "",
                       const std::string &boundaries = "",
                       const std::string &mesh       = slab<dim>())
      : Statics<dim>(
          mesh,
          {{"soil", "linear elastic"}},
          material("soil", stiff) + in_section("Boundaries", boundaries) +
            in_section("Obstacles",
                       in_section("bed",
                                  "set Shape = half-plane\n" +
                                    (contains(bed, "Point") ? std::string()
                                                            : level()) +
                                    bed)),
          MPI_COMM_WORLD,
          {"bed"})
    {
      this->contact.open_accounts(this->accounts);
      prepare_contact();
    }

    /// Call after each change of the mesh.
    void
    prepare_contact()
    {
      facets.prepare(grid, obstacles);
      contact_nodes.prepare(grid);
      soil_at_places.prepare(grid, 0, false);
      constraints.prepare();
    }

    static std::string
    level()
    {
      return dim == 2 ? "set Point = 0, 2\nset Normal = 0, 1\n"
                      : "set Point = 0, 2, 0\nset Normal = 0, 1, 0\n";
    }

    /// Boxes of half a metre from @p lower to @p upper, m, along x and y; along
    /// z through the mesh.
    void
    fill_boxes(const Point<2> &lower, const Point<2> &upper)
    {
      Point<dim>                    from, to;
      std::array<unsigned int, dim> n;
      for (unsigned int d = 0; d < dim; ++d)
        {
          from[d] = d < 2 ? lower[d] : 0.;
          to[d]   = d < 2 ? upper[d] : 2.;
          n[d]    = std::lround((to[d] - from[d]) / 0.5);
        }
      this->fill(from, to, n);
      this->load(Tensor<1, dim>());
      this->constants.box_shape = this->transfer.box_shape();
    }

    /// Give all points the velocity @p v, m/s, and compute the velocities of
    /// the nodes.
    void
    move(const Tensor<1, dim> &v)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        this->set(points.velocity, p, v);
      this->scatter();
      nodes.update_momentum(this->time_step, this->constants.mass_cutoff);
      nodes.share_with_ghosts(grid);
    }

    void
    find_constraints(const bool has_memory = false)
    {
      contact_nodes.hold_walls(*this, this->boundaries);
      soil_at_places.find(*this);
      contact_nodes.load(*this);
      constraints.begin_step();
      constraints.find(*this, has_memory);
    }

    /// Call action(node, x) for the nodes of the facets of this rank.
    template <typename Action>
    void
    for_each_node_of_facets(const Action &action) const
    {
      for (const ContactFacet<dim> &facet : facets.owned())
        for (unsigned int v = 0; v < facet.node.size(); ++v)
          action(facet.node[v], grid.cells()[facet.cell].vertex(v));
    }

    Facets<dim>             facets;
    SoilAtPlaces<dim>       soil_at_places{obstacles, facets};
    ContactNodes<dim>       contact_nodes{facets};
    BedSlip<dim>            no_slip;
    FaceNodes<dim>          face_nodes{this->boundaries};
    ContactConstraints<dim> constraints{
      obstacles, facets, face_nodes, contact_nodes, soil_at_places, no_slip};
  };



  template <int dim>
  Tensor<1, dim>
  vector_xy(const double x, const double y)
  {
    Tensor<1, dim> v;
    v[0] = x;
    v[1] = y;
    return v;
  }
} // namespace

#endif

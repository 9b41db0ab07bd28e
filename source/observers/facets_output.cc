// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/geometry/clip_simplex.h>
#include <talus/observers/facets_output.h>
#include <talus/observers/state_cells.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Lengths along @p axes, m, of the part of the plane of the facet inside
    /// the cell; 0 if the plane is a face of the cell.
    std::array<double, 2>
    lengths_in_cell(const Cell<3>                     &cell,
                    const ContactFacet<3>             &facet,
                    const std::array<Tensor<1, 3>, 2> &axes)
    {
      std::array<double, 2> least{}, largest{};
      for (const Simplex<3> &simplex : simplices_of(cell.box(), cell.lower))
        {
          std::array<double, 4> height;
          for (unsigned int v = 0; v < 4; ++v)
            height[v] = (simplex[v] - facet.centroid) * facet.normal;
          for (const Point<3> &x : clip_simplex<3>(simplex, height).facet)
            for (unsigned int i = 0; i < 2; ++i)
              {
                const double at = (x - facet.centroid) * axes[i];
                least[i]        = std::min(least[i], at);
                largest[i]      = std::max(largest[i], at);
              }
        }
      return {{largest[0] - least[0], largest[1] - least[1]}};
    }



    /// Edge of the line that represents a facet, m.
    std::array<Tensor<1, 2>, 1>
    edges_of(const Cell<2> & /*cell*/, const ContactFacet<2> &facet)
    {
      return {{facet.area * Point<2>(facet.normal[1], -facet.normal[0])}};
    }



    /// Edges of the rectangle that represents a facet, m: proportions of the
    /// plane inside the cell, area of the facet. The edges follow the mesh axis
    /// closest to the plane of the facet, so that adjacent facets on a prism
    /// tile the surface.
    std::array<Tensor<1, 3>, 2>
    edges_of(const Cell<3> &cell, const ContactFacet<3> &facet)
    {
      unsigned int along = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(facet.normal[d]) < std::abs(facet.normal[along]))
          along = d;
      Tensor<1, 3> first;
      first[along] = 1.;
      first -= facet.normal[along] * facet.normal;
      first /= first.norm();
      const std::array<Tensor<1, 3>, 2> axes = {
        {first, cross_product_3d(facet.normal, first)}};
      auto length = lengths_in_cell(cell, facet, axes);
      if (std::min(length[0], length[1]) < 1e-3 * cell.size)
        length = {{1., 1.}};
      const double factor = std::sqrt(facet.area / (length[0] * length[1]));
      return {{factor * length[0] * axes[0], factor * length[1] * axes[1]}};
    }



    template <int dim>
    void
    add_cell(OutputCells             &cells,
             const Cell<dim>         &cell,
             const ContactFacet<dim> &facet)
    {
      const auto edges = edges_of(cell, facet);
      for (unsigned int v = 0; v < cells.n_vertices_per_cell(); ++v)
        {
          Point<dim> corner = facet.centroid;
          for (unsigned int e = 0; e < edges.size(); ++e)
            corner += ((v >> e) & 1 ? 0.5 : -0.5) * edges[e];
          cells.add_vertex(corner);
        }
    }



    /// Velocity of the soil relative to and along the surface, m/s, from the
    /// nodal velocities after the step, which belong to the middle of the step.
    template <int dim>
    Tensor<1, dim>
    slip_velocity(const Contact<dim> &contact,
                  const State<dim>   &state,
                  const unsigned int  c)
    {
      const ContactFacet<dim> &facet = contact.facets().owned()[c];
      Tensor<1, dim> u = -contact.obstacles()[facet.obstacle].velocity(
        state.time - 0.5 * state.time_step);
      for (unsigned int v = 0; v < facet.node.size(); ++v)
        if (const double share = contact.constraints()[c].share[v]; share > 0)
          u += share * state.nodes.velocity(facet.node[v]);
      return u - (u * facet.normal) * facet.normal;
    }



    /// Add slip and share left of the facets, where either matters.
    template <int dim>
    void
    add_slip_fields(const Contact<dim> &contact, std::vector<Field> &fields)
    {
      const BedSlip<dim> &slip = contact.slip();
      if (!contact.obstacles().change_by_slip() && !slip.has_region())
        return;
      fields.push_back(
        scalar_field("slip of the bed", "m", [&slip](const unsigned int c) {
          return slip.state(c).slip;
        }));
      fields.push_back(scalar_field(
        "share of bed shear stress left", "", [&contact](const unsigned int c) {
          const ContactFacet<dim> &facet = contact.facets().owned()[c];
          return contact.obstacles()[facet.obstacle].bed().share_left(
            contact.slip().state(c));
        }));
    }



    // Stresses refer to the whole area of the facet, which may be covered by
    // soil only partly: the integrals are correct, and the stresses stay
    // bounded where soil is thin.
    /// Fields of facets by facet number, evaluated when a file is written.
    template <int dim>
    std::vector<Field>
    facet_fields(const Contact<dim> &contact, const State<dim> &state)
    {
      const auto       &facets      = contact.facets().owned();
      const auto       &impulses    = contact.impulses();
      const auto       &constraints = contact.constraints();
      const double      dt          = contact.previous_time_step();
      const std::string area        = (dim == 2 ? "m" : "m^2");
      const auto        stress      = [&facets, dt](const unsigned int c,
                                        const auto        &impulse) {
        return impulse / (dt * facets[c].area);
      };
      std::vector<Field> fields = {
        vector_field<dim>("traction",
                          "Pa",
                          [&, stress](const unsigned int c) {
                            return stress(c,
                                          -(impulses[c].normal *
                                              facets[c].normal +
                                            impulses[c].tangential));
                          }),
        scalar_field("normal pressure",
                     "Pa",
                     [&, stress](const unsigned int c) {
                       return stress(c, impulses[c].normal);
                     }),
        scalar_field("shear stress",
                     "Pa",
                     [&, stress](const unsigned int c) {
                       return stress(c, impulses[c].tangential.norm());
                     }),
        vector_field<dim>(
          "normal", "", [&](const unsigned int c) { return facets[c].normal; }),
        vector_field<dim>("slip velocity",
                          "m/s",
                          [&](const unsigned int c) {
                            return slip_velocity(contact, state, c);
                          }),
        scalar_field("gap",
                     "m",
                     [&](const unsigned int c) { return constraints[c].gap; }),
        scalar_field("area",
                     area,
                     [&](const unsigned int c) { return facets[c].area; }),
        scalar_field("contact area",
                     area,
                     [&](const unsigned int c) {
                       return impulses[c].acts() ? constraints[c].area : 0.;
                     }),
        scalar_field("obstacle", "", [&](const unsigned int c) {
          return facets[c].obstacle;
        })};
      add_slip_fields(contact, fields);
      return fields;
    }
  } // namespace



  /// Nothing is written before the first step (or the first equilibrium): until
  /// then loaded facets are unknown.
  template <int dim>
  void
  FacetsOutput<dim>::observe(const State<dim> &state)
  {
    if (contact_.previous_time_step() == 0)
      return;
    OutputCells cells =
      state_cells(state,
                  facet_fields(contact_, state),
                  ItemsAt::cells,
                  dim == 2 ? CellShape::line : CellShape::quad);
    for (const unsigned int c : contact_.constraints().loaded())
      {
        const ContactFacet<dim> &facet = contact_.facets().owned()[c];
        add_cell(cells, state.grid.cells()[facet.cell], facet);
        cells.items.push_back(c);
      }
    this->series_.write(cells);
  }



  template class FacetsOutput<2>;
  template class FacetsOutput<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/ground.h>
#include <talus/maps/bed_shear.h>

namespace talus
{
  using namespace dealii;

  /// The force of a facet is distributed over the plan area of the cell, and
  /// the force of a node over half a cell to each side: on a steep bed, the
  /// force lost where a facet ends comes back from the cell below or above.
  template <int dim>
  void
  add_bed_shear(const State<dim>        &state,
                const FacetContact<dim> &contact,
                const Boundaries<dim>   &boundaries,
                ColumnSums<dim>         &sums)
  {
    if (const double dt = contact.previous_time_step();
        dt > 0 && !contact.obstacles().empty())
      {
        const Ground<dim> ground(state.grid.domain(), &contact.obstacles());
        const auto       &facets = contact.facets().owned();
        for (unsigned int c = 0; c < contact.impulses().size(); ++c)
          if (const auto &impulse = contact.impulses()[c].tangential;
              impulse.norm_square() > 0 && ground.contains(facets[c].obstacle))
            sums.add_bed_force(impulse / dt,
                               state.grid.cells()[facets[c].cell].box());
      }
    const double   h      = state.grid.finest_size();
    const Box<dim> domain = state.grid.domain();
    for (const auto &[x, force] : boundaries.bed_friction())
      {
        Box<dim> box{x, x};
        for (unsigned int d = 0; d < dim; ++d)
          {
            box.lower[d] = std::max(x[d] - 0.5 * h, domain.lower[d]);
            box.upper[d] = std::min(x[d] + 0.5 * h, domain.upper[d]);
          }
        sums.add_bed_force(force, box);
      }
  }



  template decltype(add_bed_shear<2>) add_bed_shear<2>;
  template decltype(add_bed_shear<3>) add_bed_shear<3>;
} // namespace talus

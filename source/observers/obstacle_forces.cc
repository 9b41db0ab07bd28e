// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/contact/box_extent.h>
#include <talus/observers/obstacle_forces.h>
#include <talus/points/points_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr double smallest_depth = 0.1; ///< below the surface [cells]
  }



  // Nothing pushes points back that have come below a surface, so the user must
  // see how much soil is below, and how deep. Points held at the surface have
  // centres a hundredth of a cell below it. Therefore the volume of a point
  // counts only if the centre is deeper than a tenth of a cell. The counted
  // share of the volume grows with the depth, and is full when the whole box is
  // below the surface.
  template <int dim>
  std::vector<typename ObstacleForces<dim>::Penetration>
  ObstacleForces<dim>::penetrations(const State<dim> &state) const
  {
    const Points<dim>       &points    = state.points;
    const Obstacles<dim>    &obstacles = contact_.obstacles();
    const Facets<dim>       &facets    = contact_.facets();
    std::vector<Penetration> result(obstacles.size());
    for (const Segment &segment : points.segments())
      {
        // In all other cells no point can be below a surface.
        const unsigned int c = segment.cell;
        if (!facets.is_cut(c) && facets.containing(c).empty())
          continue;
        const Cell<dim>               &cell = state.grid.cells()[c];
        const ContactFacet<dim> *const flat = facets.flat_facet(c);
        for (const unsigned int k : obstacles.near(cell.box(), cell.size))
          for (unsigned int p = segment.begin; p < segment.end; ++p)
            {
              const Point<dim> x = load_place(points, points.position, p);
              // The distance from a terrain is expensive.
              if (flat && flat->obstacle == k &&
                  flat->distance_from_plane(x) > 0.02 * cell.size)
                continue;
              const auto [distance, normal] =
                obstacles[k].distance_and_normal(x);
              if (distance >= 0)
                continue;
              const double support =
                support_of_box(half_lengths_of_box(points, p), normal);
              const double v     = volume_of_points<dim, double>(points, p);
              Penetration &own   = result[k];
              const double depth = -distance / cell.size;
              if (depth > smallest_depth)
                own.volume += v * std::min(1., -distance / support);
              own.deepest  = std::max(own.deepest, -distance);
              own.in_cells = std::max(own.in_cells, depth);
            }
      }
    return result;
  }



  /// List the soil below the surface of obstacle @p k, over all ranks. @p own
  /// is the soil on this rank. Collective.
  template <int dim>
  void
  ObstacleForces<dim>::list_penetration(const unsigned int k,
                                        const Penetration &own,
                                        const State<dim>  &state,
                                        Quantities        &row) const
  {
    const MPI_Comm    communicator = state.communicator();
    const std::string name         = contact_.obstacles()[k].name() + ' ';
    row.push_back({name + "volume below surface",
                   dim == 2 ? "m^2" : "m^3",
                   Utilities::MPI::sum(own.volume, communicator)});
    row.push_back({name + "depth below surface",
                   "m",
                   Utilities::MPI::max(own.deepest, communicator)});
    row.push_back({name + "deepest point",
                   "cells",
                   Utilities::MPI::max(own.in_cells, communicator)});
  }



  /// List motion and springs of obstacle @p k, if it has a mass.
  template <int dim>
  void
  ObstacleForces<dim>::list_motion(const unsigned int k, Quantities &row) const
  {
    const Obstacle<dim>  &obstacle = contact_.obstacles()[k];
    const RigidBody<dim> &body     = obstacle.body();
    if (!body.exists())
      return;
    const auto append = [&](const std::string &what,
                            const std::string &unit,
                            const auto        &by_axis) {
      Tensor<1, dim> v;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = by_axis[d];
      append_vector<dim>(row, name(k) + ' ' + what, unit, v);
    };
    append("velocity", "m/s", body.velocity());
    append("spring force", "N", body.spring_force());
    append("spring slip", "m", body.spring_slip());
    if (!body.rotates())
      return;
    row.push_back({name(k) + " rotation", "rad", obstacle.angle()});
    row.push_back({name(k) + " angular velocity", "rad/s", body.velocity()[2]});
    row.push_back({name(k) + " spring moment", "N m", body.spring_force()[2]});
    row.push_back({name(k) + " spring rotation", "rad", body.spring_slip()[2]});
  }



  template <int dim>
  Quantities
  ObstacleForces<dim>::evaluate(const State<dim> &state) const
  {
    const std::vector<Penetration> own = penetrations(state);
    Quantities                     row = {{"time", "s", state.time}};
    for (unsigned int k = 0; k < contact_.obstacles().size(); ++k)
      {
        this->list_reaction(k, row);
        append_vector<dim>(row,
                           name(k) + " displacement",
                           "m",
                           contact_.obstacles()[k].displacement());
        list_motion(k, row);
        list_penetration(k, own[k], state, row);
      }
    return row;
  }



  template class ObstacleForces<2>;
  template class ObstacleForces<3>;
} // namespace talus

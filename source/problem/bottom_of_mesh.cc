// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/side_of_surface.h>
#include <talus/problem/bottom_of_mesh.h>
#include <talus/problem/plan_places.h>

namespace talus
{
  using namespace dealii;

  // Not an error, because the soil may never get there. Without the note a run
  // would end unexpectedly, perhaps after days.
  template <int dim>
  std::string
  note_on_bottom(const Obstacles<dim> &obstacles,
                 const Box<dim>       &domain,
                 const double          cell_size)
  {
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        const Shape<dim> &shape = obstacles[k].shape();
        if (dynamic_cast<const SideOfSurface<dim> *>(&shape) == nullptr)
          continue;
        double     depth = 0.; // depth of the surface below the bottom, m
        Point<dim> deepest;
        for (const Point<dim> &x : plan_places(domain, cell_size))
          if (obstacles.signed_distance(x) > 0.)
            {
              const auto [distance, normal] = shape.distance_and_normal(x);
              if (distance / normal[1] > depth)
                {
                  depth   = distance / normal[1];
                  deepest = x;
                }
            }
        if (depth > 0.)
          return text("The surface of the obstacle '",
                      obstacles[k].name(),
                      "' goes up to ",
                      depth,
                      " m below the bottom of the mesh, most at (",
                      deepest,
                      ") m. Soil that comes to such a place leaves the mesh, "
                      "and the run ends. If it can come so far, make y of "
                      "'Grid/Lower corner' smaller.");
      }
    return "";
  }



  template decltype(note_on_bottom<2>) note_on_bottom<2>;
  template decltype(note_on_bottom<3>) note_on_bottom<3>;
} // namespace talus

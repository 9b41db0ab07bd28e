// SPDX-License-Identifier: LGPL-2.1-or-later
// Layers thinner than a cell on a seabed and on obstacles: friction under a
// maximum shear stress must not depend on the thickness of the layer in cells.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string on_obstacle = "verification/block-on-plane.prm",
                    on_face     = "verification/block-on-incline.prm";

  constexpr double g = 9.81, degree = M_PI / 180.;      // m/s^2, rad
  constexpr double h = 0.25, length = 20 * h;           // m
  constexpr double density = 2000.;                     // kg/m^3
  const double     drive   = g * std::sin(17 * degree); // m/s^2

  /// A bed turned by an angle, degrees, through the mesh and lifted by a height,
  /// m: places and directions along it.
  struct Bed
  {
    Bed(const double angle, const double height = 0)
      : angle(angle)
      , height(height)
      , c(std::cos(angle * degree))
      , s(std::sin(angle * degree))
    {}

    /// Place at @p u m along the bed and @p v m above it.
    std::string
    place(const double u, const double v) const
    {
      char buffer[80];
      std::snprintf(buffer,
                    sizeof buffer,
                    "%.15g,%.15g",
                    u * c + v * s,
                    -u * s + v * c + height);
      return buffer;
    }

    double angle, height, c, s;
  };



  /// What all slabs share, on a slope of 17 degrees to gravity.
  Overrides
  slab_on(const double angle)
  {
    return {"Gravity/Slope angle=" + std::to_string(17 - angle),
            "Bodies/block/Filling=clipped",
            "Materials/stiff/Young's modulus=1e6",
            "Grid/Upper corner=12, 2",
            "Output/Statistics interval=0.05",
            "End time=2"};
  }



  /// A slab 20 cells long and @p thickness m thick on a plane through the mesh,
  /// with its friction coefficient and maximum shear stress.
  Overrides
  slab_on_plane(const Bed         &bed,
                const double       thickness,
                const std::string &coefficient,
                const std::string &cap)
  {
    return slab_on(bed.angle) +
           Overrides{"Bodies/block/Vertices=" + bed.place(0, 0) + "; " +
                       bed.place(length, 0) + "; " +
                       bed.place(length, thickness) + "; " +
                       bed.place(0, thickness),
                     "Obstacles/plane/Point=" + bed.place(0, 0),
                     text("Obstacles/plane/Normal=", bed.s, ",", bed.c),
                     "Obstacles/plane/Friction coefficient=" + coefficient,
                     "Obstacles/plane/Maximum shear stress=" + cap};
  }



  /// The same on the bottom of the mesh.
  Overrides
  slab_on_seabed(const double       thickness,
                 const std::string &coefficient,
                 const std::string &cap)
  {
    return slab_on(0) +
           Overrides{text("Bodies/block/Upper corner=", length, ",", thickness),
                     "Boundaries/Seabed/Friction coefficient=" + coefficient,
                     "Boundaries/Seabed/Maximum shear stress=" + cap};
  }



  /// The maximum shear stress that takes half of the drive, Pa.
  std::string
  half_of_drive(const double thickness)
  {
    return std::to_string(0.5 * density * thickness * drive);
  }



  /// Acceleration along the bed over the last of two seconds, m/s^2.
  double
  acceleration(const Table &table, const Bed &bed)
  {
    std::vector<double> v = table["centre velocity x [m/s]"];
    const auto         &y = table["centre velocity y [m/s]"];
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = v[i] * bed.c - y[i] * bed.s;
    return slope(table["time [s]"], v, 1., 2.);
  }
} // namespace



// On the seabed, a face of the mesh: boxes tile it.
TEST(ThinLayers, CapOnSeabed)
{
  Verification gates("Slab thinner than a cell on 17 degrees, seabed",
                     "prm/" + on_face + ", slab of 20 cells, tau_max alone",
                     "g sin - tau_max/(rho t)");
  const Bed    bed(0);
  for (const double t : {0.125, 0.25, 0.5, 0.75, 1., 2.})
    {
      const Table table =
        run<2>(on_face,
               "thin-slab",
               slab_on_seabed(t * h, "10", half_of_drive(t * h)));
      gates.near("acceleration [m/s^2], t = " + text(t) + " h",
                 acceleration(table, bed),
                 0.5 * drive,
                 0.005);
    }
}



namespace
{
  struct Inclined
  {
    std::string name;
    Bed         bed;
    double      thickness; ///< cells
    double      tolerance;
  };
} // namespace



// Through the mesh: boxes parallel to the axes neither tile a layer that is
// inclined nor end where it ends.
TEST(ThinLayers, CapOnObstacle)
{
  Verification gates("Slab thinner than a cell on 17 degrees, obstacle",
                     "prm/" + on_obstacle + ", slab of 20 cells, tau_max alone",
                     "g sin - tau_max/(rho t)");
  const Bed    on_mesh_face(0), parallel(0, 0.37 * h), by_5(5), by_17(17);
  for (const auto &[name, bed, t, tolerance] :
       std::vector<Inclined>{{"on a mesh face", on_mesh_face, 0.125, 0.02},
                             {"on a mesh face", on_mesh_face, 0.5, 0.02},
                             {"parallel", parallel, 0.125, 0.02},
                             {"parallel", parallel, 0.25, 0.02},
                             {"parallel", parallel, 0.5, 0.02},
                             {"parallel", parallel, 1., 0.02},
                             {"parallel", parallel, 2., 0.02},
                             {"turned by 5 degrees", by_5, 0.25, 0.05},
                             {"turned by 5 degrees", by_5, 1., 0.05},
                             {"turned by 17 degrees", by_17, 0.125, 0.08},
                             {"turned by 17 degrees", by_17, 0.25, 0.02},
                             {"turned by 17 degrees", by_17, 0.5, 0.02},
                             {"turned by 17 degrees", by_17, 1., 0.02}})
    {
      const Table table =
        run<2>(on_obstacle,
               "thin-slab",
               slab_on_plane(bed, t * h, "10", half_of_drive(t * h)));
      // The friction, not the acceleration, is what the area decides.
      gates.near("friction [m/s^2], " + name + ", t = " + text(t) + " h",
                 drive - acceleration(table, bed),
                 0.5 * drive,
                 tolerance);
    }
}



// What does not depend on the area must not change with the thickness either.
TEST(ThinLayers, CoulombAndNoFriction)
{
  Verification gates("Slab thinner than a cell on 17 degrees, no tau_max",
                     "prm/" + on_obstacle + " and prm/" + on_face +
                       ", slab of 20 cells",
                     "g (sin - mu cos)");
  const Bed    on_mesh_face(0), parallel(0, 0.37 * h);
  const double slowed = drive - 0.1 * g * std::cos(17 * degree);
  for (const double t : {0.25, 0.5})
    {
      const Table on_bed =
        run<2>(on_face, "thin-slab", slab_on_seabed(t * h, "0.1", "1e12"));
      gates.near("seabed, mu = 0.1, t = " + text(t) + " h",
                 acceleration(on_bed, on_mesh_face),
                 slowed,
                 5e-4);
      for (const auto &[mu, exact] :
           {std::pair("0", drive), std::pair("0.1", slowed)})
        gates.near(
          text("obstacle, mu = ", mu, ", t = ", t, " h"),
          acceleration(run<2>(on_obstacle,
                              "thin-slab",
                              slab_on_plane(parallel, t * h, mu, "1e12")),
                       parallel),
          exact,
          5e-4);
    }
}



// The static stages see the same area.
TEST(ThinLayers, FactorOfSafety)
{
  Verification gates("Slab thinner than a cell on 17 degrees",
                     "prm/" + on_obstacle + " with static stages",
                     "F = tau_max/(rho g t sin)");
  const Bed    parallel(0, 0.37 * h);
  const auto   stages = Overrides{"Stages=equilibrium, strength reduction"};
  for (const double t : {0.25, 0.5})
    {
      const std::string   cap = std::to_string(1.5 * density * t * h * drive);
      const StaticCase<2> on_bed(on_face,
                                 "thin-slab-safety",
                                 slab_on_seabed(t * h, "10", cap) + stages);
      gates.near("seabed, t = " + text(t) + " h",
                 on_bed.factor_of_safety(),
                 1.5,
                 0.02);
      const StaticCase<2> on_solid(on_obstacle,
                                   "thin-slab-safety",
                                   slab_on_plane(parallel, t * h, "10", cap) +
                                     stages);
      gates.near("obstacle, t = " + text(t) + " h",
                 on_solid.factor_of_safety(),
                 1.5,
                 0.02);
    }
}

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

// A namespace of its own: several files are compiled as one.
namespace thin_layers
{
  namespace
  {
    const std::string on_obstacle = "verification/block-on-plane.prm",
                      on_face     = "verification/block-on-incline.prm";

    constexpr double g = 9.81, degree = M_PI / 180.;      // m/s^2, rad
    constexpr double h = 0.25, length = 20 * h;           // m
    constexpr double density = 2000.;                     // kg/m^3
    const double     drive   = g * std::sin(17 * degree); // m/s^2

    /// A bed turned by an angle, degrees, through the mesh and lifted by a
    /// height, m: places and directions along it.
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



    /// A slab 20 cells long and @p thickness m thick on a plane through the
    /// mesh, with its friction coefficient and maximum shear stress.
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
             Overrides{
               text("Bodies/block/Upper corner=", length, ",", thickness),
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
                       "prm/" + on_obstacle +
                         ", slab of 20 cells, tau_max alone",
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



  namespace
  {
    /// A sheet of clay in the depth-averaged theory of @cite savage1989, with a
    /// largest shear stress at the base, a film, and the strength of the clay
    /// along the sheet. Slices keep their soil; their sides move.
    class DepthAveragedSheet
    {
    public:
      struct Base
      {
        double shear_stress; ///< Pa
        double film;         ///< K/b, Pa s/m, of exponent 1
      };

      DepthAveragedSheet(const Base &base, const double strength)
        : base_(base)
        , strength_(strength)
      {
        for (unsigned int i = 0; i <= n_slices; ++i)
          {
            x_.push_back(-15. + 30. * i / n_slices);
            u_.push_back(0.);
          }
      }

      void
      run(const double end)
      {
        while (time_ < end)
          step(end);
      }

      double
      centre() const
      {
        double sum = 0;
        for (unsigned int i = 0; i < n_slices; ++i)
          sum += 0.5 * (x_[i] + x_[i + 1]);
        return sum / n_slices;
      }

      double
      front() const
      {
        return x_.back();
      }

      static constexpr double slope = 3. * degree;

    private:
      static constexpr unsigned int n_slices = 200;
      static constexpr double       rho = 1600., area = 60. / n_slices; // m^2

      double
      time_step(const double end) const
      {
        double dt = std::min(0.005, end - time_);
        for (unsigned int i = 0; i < n_slices; ++i)
          {
            const double dx = x_[i + 1] - x_[i];
            dt              = std::min(dt,
                          0.2 * dx /
                            (std::abs(u_[i + 1] - u_[i]) +
                             std::sqrt(g * area / dx)));
          }
        return dt;
      }

      /// Force of a slice along the sheet, N/m, tension positive: weight,
      /// strength (2 s_u against stretching or shortening), and a viscosity for
      /// bores.
      double
      normal_force(const unsigned int i, const double dt) const
      {
        const double dx = x_[i + 1] - x_[i], du = u_[i + 1] - u_[i];
        const double thickness = area / dx;
        const double full_rate =
          std::max(0.02, 8. * strength_ * dt / (rho * dx * dx));
        const double bore =
          du < 0 ? rho * thickness *
                     (1.5 * du * du - 0.5 * std::sqrt(g * thickness) * du)
                 : 0.;
        return -0.5 * rho * g * std::cos(slope) * thickness * thickness +
               2. * strength_ * thickness *
                 std::clamp(du / dx / full_rate, -1., 1.) -
               bore;
      }

      void
      step(const double end)
      {
        const double        dt = time_step(end);
        std::vector<double> force(n_slices + 1, 0.), mass(n_slices + 1, 0.),
          length(n_slices + 1, 0.);
        for (unsigned int i = 0; i < n_slices; ++i)
          {
            const double N = normal_force(i, dt);
            force[i] += N;
            force[i + 1] -= N;
            for (const unsigned int side : {i, i + 1})
              {
                mass[side] += 0.5 * rho * area;
                length[side] += 0.5 * (x_[i + 1] - x_[i]);
              }
          }
        for (unsigned int i = 0; i <= n_slices; ++i)
          {
            const double trial =
              u_[i] + dt * (force[i] / mass[i] + g * std::sin(slope));
            const double slows = dt * length[i] / mass[i];
            const double speed =
              std::max(0., std::abs(trial) - slows * base_.shear_stress) /
              (1. + slows * base_.film);
            u_[i] = std::copysign(speed, trial);
          }
        for (unsigned int i = 0; i <= n_slices; ++i)
          x_[i] += dt * u_[i];
        time_ += dt;
      }

      Base                base_;
      double              strength_, time_ = 0;
      std::vector<double> x_, u_; ///< of the sides of slices, m, m/s
    };



    Overrides
    sheet(const double cell_size, const double cap)
    {
      return {text("Grid/Cell size=", cell_size),
              text("Boundaries/Seabed/Maximum shear stress=", cap)};
    }
  } // namespace



  // Friction, whatever brakes beyond gravity, is what the thickness in cells
  // must not change: the sheet thins from 2.5 or 5 cells to a tenth of one at
  // its ends.
  TEST(ThinLayers, SheetThatThinsOut)
  {
    Verification gates("Sheet of clay that thins out, 3 degrees",
                       "talus tests/cases/thin-sheet.prm",
                       "depth-averaged, solved in the test");
    const double end = 12.;
    for (const double cap : {100., 200., 400.})
      {
        DepthAveragedSheet reference({cap, 0.}, 500.);
        reference.run(end);
        const double free_fall =
          0.5 * g * std::sin(DepthAveragedSheet::slope) * end * end;
        for (const double cell : {0.8, 0.4})
          {
            const Table table =
              run<2>("thin-sheet.prm", "thin-sheet", sheet(cell, cap));
            const double      way = table["centre x [m]"].back();
            const std::string where =
              text(", tau_max = ", cap, " Pa, h = ", cell, " m");
            gates.near("way of the centre [m]" + where,
                       way,
                       reference.centre(),
                       0.05);
            gates.near("way that friction takes [m]" + where,
                       free_fall - way,
                       free_fall - reference.centre(),
                       0.1);
            double share = 0;
            for (unsigned int row = 0; row < table.n_rows(); ++row)
              if (table["time [s]"][row] >= 1.)
                share = std::max(share,
                                 std::abs(table["contact area [m]"][row] /
                                            table["footprint [m]"][row] -
                                          1.));
            gates.at_most("contact area/footprint - 1" + where, share, 0.05);
          }
      }
  }



  // Mud that sticks to its base: cells too coarse for the sheared layer need
  // the film.
  TEST(ThinLayers, SheetOnAFilm)
  {
    Verification gates(
      "Sheet of mud on a film, 3 degrees",
      "talus tests/cases/thin-sheet.prm with a film of 50 Pa s "
      "and 0.25 m, tau_max = 200 Pa, s_u = 2 kPa",
      "depth-averaged, solved in the test");
    DepthAveragedSheet reference({200., 200.}, 2000.);
    reference.run(12.);
    for (const double cell : {0.8, 0.4})
      {
        const Table table =
          run<2>("thin-sheet.prm",
                 "thin-sheet",
                 sheet(cell, 200.) +
                   Overrides{"Materials/clay/Undrained shear strength=2000",
                             "Materials/clay/Young's modulus=2e5",
                             "Boundaries/Seabed/Film consistency=50",
                             "Boundaries/Seabed/Film thickness=0.25"});
        gates.near(text("way of the centre [m], h = ", cell, " m"),
                   table["centre x [m]"].back(),
                   reference.centre(),
                   0.05);
      }
  }
} // namespace thin_layers

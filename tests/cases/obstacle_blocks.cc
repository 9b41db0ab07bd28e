// SPDX-License-Identifier: LGPL-2.1-or-later
// Stiff bodies on surfaces that lie anywhere in the mesh: blocks on a plane
// (prm/verification/block-on-plane.prm), soil in a container (container.prm), a
// pendulum in a bowl (bowl.prm).

#include "static_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace talus;
using namespace talus::cases;

namespace
{
  const std::string block  = "verification/block-on-plane.prm";
  constexpr double  g      = 9.81; // m/s^2
  constexpr double  degree = M_PI / 180.;

  /// Axes of a plane that is turned by an angle, in degrees, through the mesh.
  struct Turned
  {
    explicit Turned(const double angle)
      : c(std::cos(angle * degree))
      , s(std::sin(angle * degree))
    {}

    /// Place at @p u along the plane and @p v above it, m.
    std::string
    place(const double u, const double v) const
    {
      char buffer[80];
      std::snprintf(
        buffer, sizeof buffer, "%.15g,%.15g", u * c + v * s, -u * s + v * c);
      return buffer;
    }

    std::string
    normal() const
    {
      return place(0, 1);
    }

    double
    along(const double x, const double y) const
    {
      return x * c - y * s;
    }

    double
    above(const double x, const double y) const
    {
      return x * s + y * c;
    }

    double c, s;
  };



  /// The block 2 m x 1 m, @p height m above a plane of @p slope degrees to
  /// gravity that is turned by @p angle through the mesh.
  Overrides
  block_on(const double angle, const double slope, const double height = 0)
  {
    const Turned at(angle);
    return {"Gravity/Slope angle=" + std::to_string(slope - angle),
            "Bodies/block/Vertices=" + at.place(0, height) + "; " +
              at.place(2, height) + "; " + at.place(2, 1 + height) + "; " +
              at.place(0, 1 + height),
            "Obstacles/plane/Normal=" + at.normal()};
  }



  Overrides
  friction(const std::string &coefficient, const std::string &cap)
  {
    return {"Obstacles/plane/Friction coefficient=" + coefficient,
            "Obstacles/plane/Maximum shear stress=" + cap};
  }



  /// A column of vectors, along or above the plane.
  std::vector<double>
  along(const Table &table, const Turned &at, const std::string &what)
  {
    std::vector<double> result =
      table[what + " x" + (what == "centre" ? " [m]" : " [m/s]")];
    const auto &y = table[what + " y" + (what == "centre" ? " [m]" : " [m/s]")];
    for (std::size_t i = 0; i < y.size(); ++i)
      result[i] = at.along(result[i], y[i]);
    return result;
  }



  double
  acceleration(const Table &table, const double angle)
  {
    return slope(table["time [s]"],
                 along(table, Turned(angle), "centre velocity"),
                 1.,
                 2.);
  }



  /// How far the centre rises above where it began, m.
  double
  lift(const Table &table, const double angle)
  {
    const Turned at(angle);
    double       result = 0;
    const auto  &x = table["centre x [m]"], &y = table["centre y [m]"];
    for (std::size_t i = 0; i < x.size(); ++i)
      result = std::max(result, at.above(x[i], y[i]) - at.above(x[0], y[0]));
    return result;
  }



  std::string
  degrees(const double angle)
  {
    return ", turned by " + std::to_string(int(angle)) + " degrees";
  }



  const std::vector<double> angles = {0, 5, 17, 30, 45};
} // namespace



TEST(BlockOnPlane, WithoutFriction)
{
  Verification gates("Block on a plane through the mesh, no friction",
                     "prm/" + block,
                     "g sin 20 degrees");
  for (const double angle : angles)
    {
      const Table table = run<2>(block,
                                 "block-on-plane",
                                 block_on(angle, 20) + friction("0", "0"));
      gates.near("acceleration [m/s^2]" + degrees(angle),
                 acceleration(table, angle),
                 g * std::sin(20 * degree),
                 0.0005);
      EXPECT_LT(lift(table, angle), 1e-3);
    }
}



TEST(BlockOnPlane, CappedInterface)
{
  Verification gates("Block on a plane through the mesh, tau_max = 1 kPa",
                     "prm/" + block,
                     "g sin - tau_max/(rho H)");
  for (const double angle : angles)
    {
      const Table  table = run<2>(block,
                                 "block-on-plane",
                                 block_on(angle, 20) + friction("10", "1e3"));
      const double exact = g * std::sin(20 * degree) - 0.5;
      if (angle == 45)
        gates.falls_short("acceleration, error over the closed form" +
                            degrees(angle),
                          std::abs(acceleration(table, angle) / exact - 1.),
                          0.005,
                          {0.01,
                           "boxes parallel to the axes cover the plane beyond "
                           "the ends of the block"});
      else
        gates.near("acceleration [m/s^2]" + degrees(angle),
                   acceleration(table, angle),
                   exact,
                   0.005);
      EXPECT_LT(lift(table, angle), 1e-3);
    }
}



// Gravity that acts at once makes the block ring, which Coulomb friction feeds:
// it chatters, and must neither climb nor slide faster or slower for it.
TEST(BlockOnPlane, CoulombFriction)
{
  const double exact =
    g * (std::sin(20 * degree) - 0.3 * std::cos(20 * degree));
  Verification gates("Block on a plane through the mesh, mu = 0.3",
                     "prm/" + block,
                     "g (sin - mu cos)");
  double       highest = 0;
  for (const double angle : angles)
    {
      const Table table = run<2>(block, "block-on-plane", block_on(angle, 20));
      gates.near("acceleration [m/s^2]" + degrees(angle),
                 acceleration(table, angle),
                 exact,
                 0.005);
      highest = std::max(highest, lift(table, angle));
    }
  gates.at_most("lift [m], at most", highest, 1e-3);
}



TEST(BlockOnPlane, SticksBelowTheAngleOfFriction)
{
  Verification gates(
    "Block on a plane of 15 degrees through the mesh, mu = 0.3",
    "prm/" + block + ", in equilibrium at the start",
    "sticks below the angle of friction");
  const double s15 = std::sin(15 * degree), c15 = std::cos(15 * degree);
  for (const double angle : {0., 5., 17., 30., 45.})
    {
      const Turned at(angle);
      // sigma = W d (-n n + tan 15 (t n + n t)), d the depth
      const auto component = [&](const double ni,
                                 const double nj,
                                 const double ti,
                                 const double tj) {
        char buffer[120];
        std::snprintf(buffer,
                      sizeof buffer,
                      "%.12g*(1-(%.15g)*x-(%.15g)*y)",
                      2000 * g * (-c15 * ni * nj + s15 * (ti * nj + ni * tj)),
                      at.s,
                      at.c);
        return std::string(buffer);
      };
      const double nx = at.s, ny = at.c, tx = at.c, ty = -at.s;
      const Table  table =
        run<2>(block,
               "block-on-plane",
               block_on(angle, 15) +
                 Overrides{
                   "Bodies/block/Initial stress=" + component(nx, nx, tx, tx) +
                   "; " + component(ny, ny, ty, ty) + "; 0; " +
                   component(nx, ny, tx, ty)});
      const auto   u     = along(table, at, "centre");
      const double creep = std::abs(u.back() - u[u.size() / 2]) / 1.;
      gates.at_most("creep [m/s]" + degrees(angle), creep, 1e-3);
      EXPECT_LT(lift(table, angle), 1e-3);
    }
}



// Gravity at once, and friction that would do at rest: the ringing must not
// wear the block loose.
TEST(BlockOnPlane, SticksAlthoughItRings)
{
  Verification gates(
    "Block on a plane of 30 degrees through the mesh, mu = 0.7",
    "prm/" + block + ", gravity at once",
    "sticks below the angle of friction");
  for (const double angle : {0., 17.})
    {
      const Table table = run<2>(block,
                                 "block-on-plane",
                                 block_on(angle, 30) + friction("0.7", "1e12"));
      const auto  u     = along(table, Turned(angle), "centre");
      gates.at_most("creep over the second second [m/s]" + degrees(angle),
                    std::abs(u.back() - u[u.size() / 2]),
                    1e-4);
      EXPECT_LT(lift(table, angle), 1e-3);
    }
}



// Strength reduction divides the friction of obstacles, too.
TEST(BlockOnPlane, FactorOfSafety)
{
  Verification gates(
    "Block on a plane of 20 degrees through the mesh, mu = 0.5",
    "prm/" + block + " with static stages",
    "F = mu/tan 20 degrees");
  for (const double angle : {0., 17.})
    {
      const StaticCase<2> at_rest(
        block,
        "block-safety",
        block_on(angle, 20) + friction("0.5", "1e12") +
          Overrides{"Stages=equilibrium, strength reduction"});
      gates.near("factor of safety" + degrees(angle),
                 at_rest.factor_of_safety(),
                 0.5 / std::tan(20 * degree),
                 0.01);
    }
}



// A slab, so that its rear edge, which lifts off, counts for little. On fine
// cells facets share nodes with many others, whose forces must not keep the
// contact from coming to rest.
TEST(BlockOnPlane, FactorOfSafetyWithCap)
{
  Verification gates("Slab on a plane of 20 degrees, tau_max = 4 kPa",
                     "prm/" + block + " with static stages",
                     "F = tau_max/(rho g H sin 20 degrees)");
  for (const double angle : {0., 17.})
    {
      const Turned        at(angle);
      const StaticCase<2> at_rest(
        block,
        "slab-safety",
        block_on(angle, 20) + friction("10", "4e3") +
          Overrides{"Stages=equilibrium, strength reduction",
                    "Grid/Cell size=0.125",
                    "Bodies/block/Vertices=" + at.place(0, 0) + "; " +
                      at.place(6, 0) + "; " + at.place(6, 0.5) + "; " +
                      at.place(0, 0.5)});
      gates.near("factor of safety" + degrees(angle),
                 at_rest.factor_of_safety(),
                 4e3 / (2000 * g * 0.5 * std::sin(20 * degree)),
                 0.01);
    }
}



// The dynamics begin with what the plane bore in equilibrium.
TEST(BlockOnPlane, StaysAtRestAfterEquilibrium)
{
  Verification gates("Block on a plane of 20 degrees, after equilibrium",
                     "prm/" + block + " with the stages equilibrium, dynamics",
                     "at rest");
  for (const double angle : {0., 17.})
    {
      const Table table =
        run<2>(block,
               "block-after-equilibrium",
               block_on(angle, 20) + friction("0.5", "1e12") +
                 Overrides{"Stages=equilibrium, dynamics", "End time=0.5"});
      gates.at_most("speed of the fastest point after 0.5 s [m/s]" +
                      degrees(angle),
                    table["maximum speed of points [m/s]"].back(),
                    1e-5);
    }
}



TEST(BlockOnPlane, In3d)
{
  Verification gates("Block on a plane through the mesh in 3-D",
                     "tests/cases/block-on-plane-3d.prm",
                     "as in 2-D");
  double       highest = 0;
  for (const double angle : {17., 30.})
    {
      Overrides settings = block_on(angle, 20);
      settings.back() += ",0";
      const double sine = std::sin(20 * degree), cosine = std::cos(20 * degree);
      const auto   measured = [&](const Overrides &more) {
        const Table table =
          run<3>("block-on-plane-3d.prm", "block-on-plane-3d", settings + more);
        highest = std::max(highest, lift(table, angle));
        return acceleration(table, angle);
      };
      gates.near("acceleration [m/s^2], no friction" + degrees(angle),
                 measured(friction("0", "0")),
                 g * sine,
                 0.0005);
      gates.near("acceleration [m/s^2], tau_max = 1 kPa" + degrees(angle),
                 measured(friction("10", "1e3")),
                 g * sine - 0.5,
                 0.005);
      gates.near("acceleration [m/s^2], mu = 0.3" + degrees(angle),
                 measured({}),
                 g * (sine - 0.3 * cosine),
                 0.005);
    }
  gates.at_most("lift [m], at most", highest, 1e-3);
}



// Contact begins where the boxes of the points meet the surface, not where the
// shape functions of its cells do, and gives no energy back.
TEST(BlockOnPlane, FallsOntoIt)
{
  Verification gates("Block falls 0.6 m onto a plane through the mesh",
                     "prm/" + block,
                     "free fall; energy");
  for (const double angle : {0., 17.})
    {
      const Table table =
        run<2>(block,
               "block-falls",
               block_on(angle, 0, 0.6) + friction("0", "0") +
                 Overrides{"Output/Statistics interval=0.002", "End time=0.6"});
      const Table forces(std::filesystem::path(TALUS_RESULTS_DIR) /
                         "block-falls" / "obstacles.csv");
      const auto &time = forces["time [s]"];
      std::size_t i    = 0;
      while (i + 1 < time.size() && forces["plane contact area [m]"][i] == 0)
        ++i;
      const double fallen = 0.5 * g * time[i] * time[i];
      gates.holds("height of fall at the first contact [m]" + degrees(angle),
                  std::to_string(fallen),
                  "0.55 to 0.61",
                  fallen > 0.55 && fallen < 0.61);
      double gain = 0;
      for (unsigned int row = 0; row < table.n_rows(); ++row)
        gain = std::max(gain,
                        table["kinetic energy [J]"][row] +
                          table["elastic energy [J]"][row] -
                          table["gravity work [J]"][row]);
      gates.at_most("energy gained, over that of the fall" + degrees(angle),
                    gain / (0.6 * g * 4000),
                    0.001);
    }
}



TEST(Container, StaysAtRest)
{
  const std::string file  = "verification/container.prm";
  const Table       table = run<2>(file, "container");
  const Table  forces(std::filesystem::path(TALUS_RESULTS_DIR) / "container" /
                     "obstacles.csv");
  const Turned at(17);
  const auto   mean = [&](const std::string &name, const bool is_floor) {
    double      sum = 0;
    const auto &x   = forces[name + " force x [N]"];
    const auto &y   = forces[name + " force y [N]"];
    for (std::size_t i = 1; i < x.size(); ++i)
      sum += is_floor ? at.above(x[i], y[i]) : at.along(x[i], y[i]);
    return std::abs(sum) / (x.size() - 1);
  };
  double fastest = 0, last = 0;
  for (unsigned int row = 0; row < table.n_rows(); ++row)
    {
      last    = std::sqrt(2 * table["kinetic energy [J]"][row] / 2000);
      fastest = std::max(fastest, last);
    }
  Verification gates("Soil in a container turned by 17 degrees",
                     "prm/" + file,
                     "stays at rest");
  gates.near("force on the floor [N]", mean("floor", true), 2000 * g, 0.003);
  const double side = 0.5 * 1000 * g * 3. / 7.;
  gates.near("force on the left wall [N]", mean("left", false), side, 0.003);
  gates.near("force on the right wall [N]", mean("right", false), side, 0.003);
  gates.at_most("rms velocity [m/s], always", fastest, 0.03);
  gates.at_most("rms velocity [m/s], at 1.5 s", last, 6e-3);
}



// A rigid sector of a ring that turns about the centre of the bowl: a pendulum
// of mass M at r_c with the moment of inertia I.
TEST(Bowl, Pendulum)
{
  const std::string file  = "verification/bowl.prm";
  const Table       table = run<2>(file, "bowl");
  const double      w = 0.15, outer = 5, inner = 4.5; // rad, m
  const double      r_c = 2 * std::sin(w) / (3 * w) *
                     (std::pow(outer, 3) - std::pow(inner, 3)) /
                     (outer * outer - inner * inner);
  const double I_over_M = 0.5 * (outer * outer + inner * inner);
  const double period   = 4 * std::sqrt(I_over_M / (g * r_c)) *
                        std::comp_ellint_1(std::sin(15 * degree));
  std::vector<double> crossings, heights;
  const auto         &t = table["time [s]"];
  const auto         &x = table["centre x [m]"], &y = table["centre y [m]"];
  const auto phi = [&](const std::size_t i) { return std::atan2(x[i], -y[i]); };
  for (std::size_t i = 1; i + 1 < t.size(); ++i)
    {
      if (phi(i) * phi(i + 1) < 0)
        crossings.push_back(t[i] -
                            phi(i) * (t[i + 1] - t[i]) / (phi(i + 1) - phi(i)));
      if ((phi(i) - phi(i - 1)) * (phi(i + 1) - phi(i)) <= 0)
        heights.push_back((1 - std::cos(phi(i))) / (1 - std::cos(phi(0))));
    }
  ASSERT_GE(crossings.size(), 5u);
  ASSERT_GE(heights.size(), 5u);
  Verification gates("Body in a circular bowl without friction",
                     "prm/" + file,
                     "pendulum");
  gates.near("period [s]", (crossings[4] - crossings[0]) / 2, period, 0.004);
  gates.at_least("height after 2.5 periods, over that at the start",
                 heights[4],
                 0.90,
                 "1");
  gates.at_most("largest such height",
                *std::max_element(heights.begin(), heights.end()),
                1.,
                "<= 1");
}



namespace
{
  /// A rigid sector of a ring on an arc of a circle, prm/verification/arc.prm.
  struct BlockOnArc
  {
    double w = 0.05, outer = 20, inner = 19.5; // rad, m
    double mu = 0, cap = 0;                    // Pa
    double density = 1000;

    double
    radius_of_centre() const
    {
      return 2 * std::sin(w) / (3 * w) *
             (std::pow(outer, 3) - std::pow(inner, 3)) /
             (outer * outer - inner * inner);
    }

    /// Square of the angular velocity at the bottom, by Runge and Kutta's
    /// method: I y'/2 = -M g r_c sin - (mu N + tau L) R with y = phi'^2, and
    /// the normal force N = M (g cos + r_c y) of a block that is short.
    double
    y_at_bottom() const
    {
      const double mass    = density * w * (outer * outer - inner * inner);
      const double inertia = 0.5 * mass * (outer * outer + inner * inner);
      const double r_c     = radius_of_centre();
      const auto   slope   = [&](const double phi, const double y) {
        const double normal   = mass * (g * std::cos(phi) + r_c * y);
        const double friction = mu * normal + cap * 2 * w * outer;
        return 2 / inertia *
               (-mass * g * r_c * std::sin(phi) - friction * outer);
      };
      const int    n    = 1000;
      const double step = 30 * degree / n;
      double       y    = 0;
      for (int i = 0; i < n; ++i)
        {
          const double phi = -30 * degree + i * step;
          const double k1  = slope(phi, y);
          const double k2  = slope(phi + step / 2, y + step / 2 * k1);
          const double k3  = slope(phi + step / 2, y + step / 2 * k2);
          const double k4  = slope(phi + step, y + step * k3);
          y += step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
      return y;
    }

    /// Square of the velocity of the centre when it passes the bottom, m^2/s^2.
    static double
    measured(const Table &table)
    {
      const auto &x = table["centre x [m]"];
      const auto &v = table["centre velocity x [m/s]"];
      std::size_t i = 0;
      while (i + 2 < x.size() && x[i + 1] < 0)
        ++i;
      const double share = -x[i] / (x[i + 1] - x[i]);
      return std::pow(v[i] + share * (v[i + 1] - v[i]), 2);
    }
  };
} // namespace



TEST(Arc, CoulombFriction)
{
  const std::string file = "verification/arc.prm";
  BlockOnArc        exact;
  exact.mu = 0.1;
  Verification("Block on an arc of 20 m, mu = 0.1",
               "prm/" + file,
               "rigid body; a thin one has 30.407")
    .near("v^2 at the bottom [m^2/s^2]",
          BlockOnArc::measured(run<2>(file, "arc-coulomb")),
          exact.y_at_bottom() * std::pow(exact.radius_of_centre(), 2),
          0.005);
}



// With E = 1e7 Pa the block rests on some of its facets only, and they pass
// 69 % of the cap.
TEST(Arc, CappedInterface)
{
  const std::string file = "verification/arc.prm";
  BlockOnArc        exact;
  exact.cap = 500;
  Verification("Block on an arc of 20 m, tau_max = 500 Pa",
               "prm/" + file,
               "rigid body")
    .near("v^2 at the bottom [m^2/s^2]",
          BlockOnArc::measured(
            run<2>(file,
                   "arc-capped",
                   {"Obstacles/arc/Friction coefficient=10",
                    "Obstacles/arc/Maximum shear stress=500"})),
          exact.y_at_bottom() * std::pow(exact.radius_of_centre(), 2),
          0.005);
}

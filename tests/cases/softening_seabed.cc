// SPDX-License-Identifier: LGPL-2.1-or-later
// A shear band that runs along a seabed that softens by slip:
// prm/verification/softening-seabed.prm, on a face of the mesh and on an
// obstacle across the cells.

#include "static_case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <regex>
#include <utility>

using namespace talus;
using namespace talus::cases;

namespace softening_seabed_test
{
  const std::string file   = "verification/softening-seabed.prm";
  const std::string source = "int (tau - tau_g) du, slab on a softening plane";

  constexpr double tau_p = 3500., tau_r = 1500., d = 0.12427 / 3.; // Pa, m
  const double     tau_g = 600. * 9.81 * std::sin(std::acos(-1.) / 36.) * 5.;



  /// Slab of Young's modulus E, Pa, on the bed: E'H u'' = tau - tau_g, with the
  /// shear compliance 1/k of the slab.
  struct Slab
  {
    explicit Slab(const double E)
      : EH(E / 0.91 * 5.)
      , k(3. * E / 2.6 / 5.)
    {}

    /// Shear stress of the bed after the slip @p p, m, in Pa.
    static double
    tau(const double p)
    {
      return tau_r + (tau_p - tau_r) * std::exp(-p / d);
    }

    /// N^2/(2 E'H) where the slip is @p p, m, under the share @p s of the
    /// weight: the integral of tau - s tau_g from the tip of the band and
    /// ahead, slip and elastic displacement.
    double
    work(const double p, const double s = 1.) const
    {
      return (tau_p - tau_r) * d * (1. - std::exp(-p / d)) -
             (s * tau_g - tau_r) * p +
             std::pow(tau(p) - s * tau_g, 2) / (2. * k);
    }

    /// Slip with the bed at s tau_g, m, where work() is largest.
    static double
    critical_slip(const double s = 1.)
    {
      return d * std::log((tau_p - tau_r) / (s * tau_g - tau_r));
    }

    /// Critical length of a zone with the shear stress @p tau_z, m.
    double
    critical_length(const double tau_z, const double s = 1.) const
    {
      return 2. * std::sqrt(2. * EH * work(critical_slip(s), s)) /
             (s * tau_g - tau_z);
    }

    /// Slip at @p x, m, beyond the end of a zone of length @p L, m, without
    /// friction, and, for a large @p x, the length that slips, m.
    std::pair<double, double>
    slip_beyond_zone(double L, double x) const;

    double EH; ///< N/m
    double k;  ///< Pa/m
  };



  template <typename Function>
  double
  bisect(const Function &f, double lower, double upper)
  {
    const bool is_positive = f(lower) > 0;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle                              = (lower + upper) / 2;
        ((f(middle) > 0) == is_positive ? lower : upper) = middle;
      }
    return lower;
  }



  // du = dp + dtau/k along dx = E'H du/N.
  std::pair<double, double>
  Slab::slip_beyond_zone(const double L, const double x) const
  {
    constexpr unsigned int n = 100000;
    const double           N = tau_g * L / 2.;
    const double           edge =
      bisect([&](const double p) { return work(p) - N * N / (2. * EH); },
             0.,
             critical_slip());
    double at = 0;
    for (unsigned int i = n; i > 0; --i)
      {
        const double p  = edge * (i - 0.5) / n;
        const double du = edge / n * (1. - (tau(p) - tau_r) / (d * k));
        at += du * EH / std::sqrt(2. * EH * work(p));
        if (at > x)
          return {p, at};
      }
    return {0., at};
  }



  /// The bed as the surface of an obstacle at 0.2 m, in cells of 0.5 m.
  const Overrides obstacle = {
    "Boundaries/Bottom=free",
    "Boundaries/Seabed/Slip to remould=0",
    "Boundaries/Seabed/Remoulded shear stress ratio=1",
    "Obstacles/Names=bed",
    "Obstacles/bed/Shape=half-plane",
    "Obstacles/bed/Point=0, 0.2",
    "Obstacles/bed/Normal=0, 1",
    "Obstacles/bed/Friction coefficient=10",
    "Obstacles/bed/Maximum shear stress=3500",
    "Obstacles/bed/Slip to remould=0.12427",
    "Obstacles/bed/Remoulded shear stress ratio=0.428571428571",
    "Bodies/slab/Lower corner=-110, 0.2",
    "Bodies/slab/Upper corner=110, 5.2"};

  struct Bed
  {
    std::string name;
    Overrides   overrides;
    std::string section; ///< of the maximum shear stress
    std::string what;    ///< in the columns of statistics.csv
    /// Distance from the middle of a zone of whole metres, in cells of 0.5 m
    /// and, for an odd number, of 1 m: facets are between the nodes.
    std::string x, x_in_large_cells;
    std::string words; ///< where there is no balance
  };

  const Bed face      = {"face of the mesh",
                         {},
                         "Boundaries/Seabed",
                         "seabed",
                         "(x - 0.25)",
                         "x",
                         "m of the seabed slipped"};
  const Bed off_cells = {"obstacle across the cells",
                         obstacle,
                         "Obstacles/bed",
                         "obstacles",
                         "x",
                         "(x - 0.5)",
                         "m of the obstacle 'bed' slipped"};



  /// A zone without friction of length @p L, an odd number of m, in static
  /// stages on cells of 1 m.
  Overrides
  frictionless_zone(const Bed &bed, const double L)
  {
    return bed.overrides +
           Overrides{"Stages=equilibrium",
                     "Grid/Cell size=1",
                     "Grid/Upper corner=110, 7",
                     "Equilibrium/Load steps=20",
                     "Equilibrium/Smallest load step=0.01",
                     "Trigger/Duration=0",
                     "Trigger/Seabed shear stress fraction=1",
                     "Trigger/Seabed region=",
                     bed.section + text("/Maximum shear stress=if(abs(",
                                        bed.x_in_large_cells,
                                        ") < ",
                                        L / 2.,
                                        ", 0, 3500)")};
  }



  Table
  statistics(const std::string &name)
  {
    return Table(std::filesystem::path(TALUS_RESULTS_DIR) / name /
                 "statistics.csv");
  }



  // A stiff slab, for which the zone is long compared with the thickness.
  void
  expect_balance(const Bed &bed)
  {
    constexpr double    L = 33.;
    const Slab          slab(2e7);
    Verification        gates("Softening bed with a zone of 33 m without "
                              "friction, E = 20 MPa, " +
                         bed.name,
                       "prm/" + file + ", Stages = equilibrium",
                       source + text(", L_cr = ",
                                     std::setprecision(3),
                                     slab.critical_length(0.),
                                     " m"));
    const std::string   name = "softening-seabed-balance";
    const StaticCase<2> band(file,
                             name,
                             frictionless_zone(bed, L) +
                               Overrides{"Materials/slab/Young's modulus=2e7"});
    const Table         table = statistics(name);
    gates.near("slip 0.5 m beside the zone [m]",
               table["largest slip of " + bed.what + " [m]"].back(),
               slab.slip_beyond_zone(L, 0.5).first,
               0.03);
    gates.near("length with slip on both sides [m]",
               table["slipped " + bed.what + " [m]"].back(),
               2. * slab.slip_beyond_zone(L, 1e9).second,
               0.03);
  }



  void
  expect_failure(const Bed &bed)
  {
    const Slab   slab(5e6);
    Verification gates("Softening bed with a zone without friction beyond the "
                       "critical length, " +
                         bed.name,
                       "prm/" + file + ", Stages = equilibrium",
                       source + text(", L_cr = ",
                                     std::setprecision(3),
                                     slab.critical_length(0.),
                                     " m; share s: L_cr(s) = L"));
    for (const double L : {25., 31.})
      {
        const std::string name = "softening-seabed-fails";
        Case<2>           band(file,
                     Overrides{"Output/Folder=" +
                               std::string(TALUS_RESULTS_DIR) + '/' + name} +
                       frictionless_zone(bed, L));
        std::string       words;
        try
          {
            band->run();
          }
        catch (const ExcUser &error)
          {
            words = std::regex_replace(error.what(), std::regex("\\s+"), " ");
          }
        const double share =
          bisect([&](
                   const double s) { return slab.critical_length(0., s) - L; },
                 0.6,
                 1.);
        gates.near(text("share of the load with a balance, L = ", L, " m"),
                   band->static_stages().equilibrium().load(),
                   share,
                   0.015 / share);
        EXPECT_NE(words.find(bed.words), std::string::npos) << words;
      }
  }



  // Strengths over F and the weight: F times the weight on the strengths, and
  // 1/F times the work.
  void
  expect_factor_of_safety()
  {
    const Slab   slab(5e6);
    Verification gates("Softening bed with a zone without friction: factor of "
                       "safety",
                       "prm/" + file + ", strength reduction",
                       source + ", strengths over F: L_cr(F) = L");
    for (const double L : {13., 17.})
      {
        const StaticCase<2> band(file,
                                 "softening-seabed-safety",
                                 frictionless_zone(face, L) +
                                   Overrides{"Stages=equilibrium, strength "
                                             "reduction",
                                             "Strength reduction/Tolerance="
                                             "0.002"});
        const double        F = bisect(
          [&](const double F) {
            return std::sqrt(F) * slab.critical_length(0., F) - L;
          },
          1.,
          1.36);
        gates.near(text("factor of safety, L = ", L, " m"),
                   band.factor_of_safety(),
                   F,
                   0.005);
      }
  }



  /// Zones of 41 and 51 m, in time: the critical length is 46.02 m.
  void
  expect_run(const Bed &bed)
  {
    const double critical = Slab(5e6).critical_length(tau_r);
    Verification gates(
      "Softening bed in time, " + bed.name,
      "prm/" + file,
      source + text(", L_cr = ", std::setprecision(4), critical, " m"));
    for (const double L : {41., 51.})
      {
        const Table table =
          run<2>(file,
                 "softening-seabed",
                 bed.overrides +
                   Overrides{text(
                     "Trigger/Seabed region=", L / 2., " - abs(", bed.x, ")")});
        const std::string quantity =
          text("kinetic energy at 20 s [J], L = ", L, " m");
        const double energy = table["kinetic energy [J]"].back();
        if (L < critical)
          gates.at_most(quantity, energy, 1.);
        else
          gates.at_least(quantity, energy, 1e5, "runs away");
        double remainder = 0;
        for (const double E : table["energy remainder [J]"])
          remainder = std::max(remainder, std::abs(E));
        gates.at_most(text("energy remainder / gravity work, L = ", L, " m"),
                      remainder / table["gravity work [J]"].back(),
                      1e-3);
      }
  }
} // namespace softening_seabed_test



TEST(SofteningSeabed, BalanceBelowTheCriticalLength)
{
  using namespace softening_seabed_test;
  EXPECT_NEAR(Slab(5e6).critical_length(tau_r), 46.02, 0.01);
  expect_balance(face);
}



TEST(SofteningSeabed, BalanceOnAnObstacle)
{
  using namespace softening_seabed_test;
  expect_balance(off_cells);
}



TEST(SofteningSeabed, NoBalanceBeyondTheCriticalLength)
{
  using namespace softening_seabed_test;
  expect_failure(face);
}



TEST(SofteningSeabed, NoBalanceOnAnObstacle)
{
  using namespace softening_seabed_test;
  expect_failure(off_cells);
}



TEST(SofteningSeabed, FactorOfSafety)
{
  using namespace softening_seabed_test;
  expect_factor_of_safety();
}



TEST(SofteningSeabed, BandInTime)
{
  using namespace softening_seabed_test;
  expect_run(face);
}



TEST(SofteningSeabed, BandInTimeOnAnObstacle)
{
  using namespace softening_seabed_test;
  expect_run(off_cells);
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// A plug enters the mesh on a roller: prm/verification/plug-inflow.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace talus;
using namespace talus::cases;

// A namespace of its own: several files are compiled as one.
namespace inflow_test
{
  namespace
  {
    const std::string file = "verification/plug-inflow.prm";

    constexpr double mass_at_start = 500.,  // kg
      mass_per_length              = 1000.; // kg/m



    /// Largest difference of a column from the start and the column of what
    /// entered.
    double
    error_of_sum(const Table       &table,
                 const std::string &inside,
                 const std::string &entered)
    {
      double      error = 0;
      const auto &sum = table[inside], &part = table[entered];
      for (unsigned int i = 0; i < table.n_rows(); ++i)
        error = std::max(error, std::abs(sum[i] - part[i] - sum[0]));
      return error;
    }
  } // namespace



  // Soil moves on as a rigid plug: front, mass, momentum and energy are known.
  TEST(Inflow, PlugEnters)
  {
    const Table  table = run<2>(file, "plug-inflow");
    Verification gates("Plug that enters through a face",
                       "prm/" + file,
                       "rigid plug");
    double       mass_error = 0, front_error = 0;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        const double t = table["time [s]"][i];
        mass_error     = std::max(mass_error,
                              std::abs(table["inflow mass [kg]"][i] -
                                       mass_per_length * t));
        front_error    = std::max(front_error,
                               std::abs(table["front x [m]"][i] -
                                        table["front x [m]"][0] - t));
      }
    const double mass   = mass_at_start + 2. * mass_per_length;
    const double energy = 0.5 * mass;
    gates.at_most("mass that entered: error / mass", mass_error / mass, 1e-12);
    gates.at_most("mass inside less entered: change / mass",
                  error_of_sum(table, "mass [kg]", "inflow mass [kg]") / mass,
                  1e-12);
    gates.at_most("momentum inside less entered: change / momentum",
                  error_of_sum(table,
                               "momentum x [kg m/s]",
                               "inflow momentum x [kg m/s]") /
                    mass,
                  1e-12);
    gates.at_most("front: error [m]", front_error, 1e-9);
    gates.near("kinetic energy [J]",
               table["kinetic energy [J]"].back(),
               energy,
               1e-9);
    gates.at_most("energy remainder / kinetic energy",
                  std::abs(table["energy remainder [J]"].back()) / energy,
                  1e-9);
  }



  // A hydrograph linear in time: the midpoint rule of the steps is exact.
  TEST(Inflow, MassIsTheIntegralOfTheDischarge)
  {
    const Table  table   = run<2>(file,
                               "plug-hydrograph",
                               {"Boundaries/Left velocity=1 - 0.25*t; free"});
    const double entered = mass_per_length * (2. - 0.5);
    EXPECT_NEAR(table["inflow mass [kg]"].back(), entered, 1e-12 * entered);
    EXPECT_LE(error_of_sum(table, "mass [kg]", "inflow mass [kg]"),
              1e-12 * entered);
  }



  // The mesh moves the soil at the face linearly between the nodes.
  TEST(Inflow, MassIsTheMassThatTheMeshMoves)
  {
    const Table table =
      run<2>(file,
             "plug-profile",
             {"Boundaries/Left velocity=1 + y^2; free", "End time=0.1"});
    const double cell = 0.125, thickness = 0.5, density = 2000.;
    const double trapezoidal_rule = thickness + std::pow(thickness, 3) / 3. +
                                    cell * cell / 12. * 2. * thickness;
    const double entered = density * trapezoidal_rule * 0.1;
    EXPECT_NEAR(table["inflow mass [kg]"].back(), entered, 1e-12 * entered);
  }



  // Points that feed are not merged, and the mesh may follow the soil.
  TEST(Inflow, FedPointsAreMerged)
  {
    const Table  table = run<2>(file,
                               "plug-merged",
                               {"Splitting/Merge=all",
                                 "Mesh tracking/Enabled=true",
                                 "Bodies/plug/Points per cell and axis=4"});
    const double mass  = mass_at_start + 2. * mass_per_length;
    EXPECT_GT(table["merges"].back(), 500);
    EXPECT_NEAR(table["mass [kg]"].back(), mass, 1e-12 * mass);
    EXPECT_NEAR(table["momentum x [kg m/s]"].back(), mass, 1e-12 * mass);
    EXPECT_NEAR(table["centre x [m]"].back(), 1.25, 1e-12);
  }



  // Means over the last 3 s, when the nose is 8 m farther down.
  TEST(FedLayer, KeepsItsThickness)
  {
    const std::string layer = "verification/fed-layer.prm";
    run<2>(layer, "fed-layer");
    const Table  table(std::filesystem::path(TALUS_RESULTS_DIR) /
                      "fed-layer/stations.csv");
    Verification gates("Bingham layer that enters a slope",
                       "prm/" + layer,
                       "uniform flow of the discharge");
    for (const std::string place : {"1", "2", "3"})
      {
        double sum = 0.;
        for (const double t : {9.5, 10., 10.5, 11., 11.5, 12.})
          sum += table.at(t, "at " + place + " m thickness [m]");
        gates.near("thickness at " + place + " m [m]", sum / 6., 1., 0.05);
      }
  }
} // namespace inflow_test

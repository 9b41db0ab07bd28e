// SPDX-License-Identifier: LGPL-2.1-or-later
// A stiff block slides down a plane of 30 degrees and out of the mesh, whose
// right face is one of outflow: prm/verification/block-on-incline.prm.

#include "case.h"
#include "verification.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace talus;
using namespace talus::cases;

// A namespace of its own: several files are compiled as one.
namespace outflow_test
{
  namespace
  {
    const std::string file = "verification/block-on-incline.prm";

    constexpr double mass_of_column = 250., // kg, of the 8 points at one x
      spacing = 0.125, face = 4.;           // m, of the columns; of the mesh
    constexpr unsigned int n_columns = 16;

    const double acceleration =
      9.81 * (std::sin(M_PI / 6.) - 0.3 * std::cos(M_PI / 6.)); // m/s^2

    const Overrides overrides = {"Grid/Upper corner=4, 2",
                                 "Boundaries/Right=outflow",
                                 "End time=2"};



    /// Way of column @p i of points to the face at the start, m.
    double
    way_to_face(const unsigned int i)
    {
      return face - (i + 0.5) * spacing;
    }



    /// Mass that a rigid block has lost by the time @p t, s, in kg.
    double
    mass_that_left(const double t)
    {
      double mass = 0;
      for (unsigned int i = 0; i < n_columns; ++i)
        if (0.5 * acceleration * t * t >= way_to_face(i))
          mass += mass_of_column;
      return mass;
    }



    /// Momentum that a rigid block takes along, kg m/s.
    double
    momentum_that_leaves()
    {
      double momentum = 0;
      for (unsigned int i = 0; i < n_columns; ++i)
        momentum +=
          mass_of_column * std::sqrt(2. * acceleration * way_to_face(i));
      return momentum;
    }
  } // namespace



  // Mass and momentum that left, as those of a rigid block; nothing is lost.
  TEST(Outflow, BlockLeavesTheMesh)
  {
    const Table  table = run<2>(file, "block-outflow", overrides);
    Verification gates("Block that slides out of the mesh",
                       "prm/" + file + ", Boundaries/Right=outflow",
                       "rigid block");
    const auto  &time = table["time [s]"], &out = table["outflow mass [kg]"],
               &inside          = table["mass [kg]"];
    constexpr double mass       = n_columns * mass_of_column;
    double           mass_error = 0, sum_error = 0;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        mass_error =
          std::max(mass_error, std::abs(out[i] - mass_that_left(time[i])));
        sum_error = std::max(sum_error, std::abs(inside[i] + out[i] - mass));
      }
    gates.at_most("mass inside and outside: error / mass",
                  sum_error / mass,
                  1e-12);
    gates.at_most("mass that left: error / mass of a column of points",
                  mass_error / mass_of_column,
                  1.);
    EXPECT_EQ(out.back(), mass);
    gates.near("momentum that left [kg m/s]",
               table["outflow momentum x [kg m/s]"].back(),
               momentum_that_leaves(),
               0.01);
    gates.at_most("energy remainder / gravity work",
                  std::abs(table["energy remainder [J]"].back()) /
                    table["gravity work [J]"].back(),
                  0.01);
  }
} // namespace outflow_test

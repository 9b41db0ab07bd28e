// SPDX-License-Identifier: LGPL-2.1-or-later
#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus::cases
{
  double
  gravity_along()
  {
    return 9.81 * std::sin(5. * M_PI / 180.);
  }



  namespace
  {
    double
    momentum_error(const Table &table)
    {
      double largest = 0;
      for (unsigned int i = 1; i < table.n_rows(); ++i)
        {
          const double driving =
            table["mass [kg]"][i] * gravity_along() * table["time [s]"][i];
          const double error = (table["momentum x [kg m/s]"][i] - driving -
                                table["seabed impulse x [N s]"][i]) /
                               driving;
          largest = (std::abs(error) <= largest ? largest : std::abs(error));
        }
      return largest;
    }



    /// (mean seabed force of the last 3 s)/(-M g sin) - 1.
    double
    force_imbalance(const Table &table)
    {
      const double end    = table["time [s]"].back();
      const double change = table["seabed impulse x [N s]"].back() -
                            table.at(end - 3., "seabed impulse x [N s]");
      const double weight = table["mass [kg]"].back() * gravity_along();
      return -change / 3. / weight - 1.;
    }



    double
    largest(const std::vector<double> &values)
    {
      return *std::max_element(values.begin(), values.end());
    }
  } // namespace



  void
  expect_momentum(Verification &gates, const Table &table)
  {
    gates.at_most("momentum: P_x - M g t sin - seabed impulse, relative",
                  momentum_error(table),
                  1e-8);
  }



  void
  expect_energy(Verification &gates,
                const Table  &table,
                const double  share,
                const double  gain)
  {
    const double work = table["gravity work [J]"].back();
    double       loss = 0, created = 0, so_far = 0;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        const double remainder = table["energy remainder [J]"][i];
        ASSERT_TRUE(std::isfinite(remainder));
        loss    = std::max(loss, remainder / work);
        created = std::max(created, -remainder / work);
        if (table["time [s]"][i] >= 2.)
          so_far = std::max(so_far,
                            std::abs(remainder) / table["gravity work [J]"][i]);
      }
    gates.at_most("energy lost / final gravity work, at most", loss, share);
    gates.at_most("energy created / final gravity work, at most",
                  created,
                  gain);
    gates.at_most("energy remainder / gravity work so far, from 2 s on",
                  so_far,
                  0.005);
  }



  void
  expect_continuum(Verification &gates, const Table &table)
  {
    const double cells   = largest(table["empty interior cells"]);
    const double columns = largest(table["empty columns"]);
    const double bodies  = largest(table["connected bodies"]);
    gates.holds("empty interior cells, empty columns, bodies, at most",
                text(cells, ", ", columns, ", ", bodies),
                "0, 0, 1",
                cells == 0 && columns == 0 && bodies == 1);
  }



  double
  time_of_rest(const Table &table)
  {
    const auto  &energy = table["grid kinetic energy [J]"];
    const double most   = largest(energy);
    unsigned int i =
      std::max_element(energy.begin(), energy.end()) - energy.begin();
    for (; i < table.n_rows(); ++i)
      if (energy[i] < 1e-3 * most)
        return table["time [s]"][i];
    return std::numeric_limits<double>::infinity();
  }



  void
  expect_rest(Verification &gates, const Table &table)
  {
    gates.at_most("seabed force over the last 3 s against the weight, relative",
                  std::abs(force_imbalance(table)),
                  0.01);
    const double height = table["height [m]"].back();
    gates.holds("highest point at rest [m]",
                text(height),
                "1.60 to 1.75",
                height >= 1.6 && height <= 1.75);
  }



  void
  expect_split_landslide(Verification &gates,
                         const Table  &table,
                         const double  share)
  {
    expect_momentum(gates, table);
    expect_energy(gates, table, share, 2e-4);
    expect_continuum(gates, table);
    const double rest = time_of_rest(table);
    gates.holds("at rest from [s]",
                text(rest),
                "24 to 27.5",
                rest >= 24. && rest <= 27.5);
    expect_rest(gates, table);
    EXPECT_GT(table["splits"].back(), 1000);
    gates.at_most("split conservation error",
                  largest(table["split conservation error [-]"]),
                  1e-12);
  }



  void
  expect_fracture(Verification &gates, const Table &table, const double least)
  {
    double fewest = 1e300, n_rows = 0, n_many = 0;
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      if (table["time [s]"][i] >= 10.)
        {
          const double n = table["empty interior cells"][i];
          fewest         = std::min(fewest, n);
          ++n_rows;
          n_many += (n >= least ? 1. : 0.);
        }
    gates.at_least("unsplit: empty interior cells from 10 s on, fewest",
                   fewest,
                   1.,
                   "fractures");
    gates.at_least(text("unsplit: share of the times from 10 s on with ",
                        least,
                        " or more"),
                   n_many / n_rows,
                   0.5,
                   "most");
  }



  double
  relative_difference(const Table       &a,
                      const Table       &b,
                      const std::string &column,
                      const double       end)
  {
    double difference = 0;
    for (double t = 0; t <= end; t += 0.25)
      difference =
        std::max(difference, std::abs(a.at(t, column) / b.at(t, column) - 1.));
    return difference;
  }

} // namespace talus::cases

#include "landslide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
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
  expect_momentum(const Table &table)
  {
    EXPECT_LE(momentum_error(table), 1e-8);
  }



  void
  expect_energy(const Table &table, const double share, const double gain)
  {
    const double work = table["gravity work [J]"].back();
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        const double t         = table["time [s]"][i];
        const double remainder = table["energy remainder [J]"][i];
        EXPECT_LE(remainder, share * work) << "t = " << t;
        EXPECT_GE(remainder, -gain * work) << "t = " << t;
        if (t >= 2.)
          {
            EXPECT_LE(std::abs(remainder), 0.005 * table["gravity work [J]"][i])
              << "t = " << t;
          }
      }
  }



  void
  expect_continuum(const Table &table)
  {
    for (unsigned int i = 0; i < table.n_rows(); ++i)
      {
        const double t = table["time [s]"][i];
        EXPECT_EQ(table["empty interior cells"][i], 0) << "t = " << t;
        EXPECT_EQ(table["empty columns"][i], 0) << "t = " << t;
        EXPECT_EQ(table["connected bodies"][i], 1) << "t = " << t;
      }
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
  expect_rest(const Table &table)
  {
    EXPECT_NEAR(force_imbalance(table), 0., 0.01);
    EXPECT_GE(table["height [m]"].back(), 1.60);
    EXPECT_LE(table["height [m]"].back(), 1.75);
  }



  void
  expect_split_landslide(const Table &table,
                         const double share,
                         const double earliest_rest,
                         const double latest_rest)
  {
    expect_momentum(table);
    expect_energy(table, share, 2e-4);
    expect_continuum(table);
    EXPECT_GE(time_of_rest(table), earliest_rest);
    EXPECT_LE(time_of_rest(table), latest_rest);
    expect_rest(table);
    EXPECT_GT(table["splits"].back(), 1000);
    EXPECT_LE(largest(table["split ledger [-]"]), 1e-12);
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



  void
  report(const std::string &name, const Table &table)
  {
    const double work      = table["gravity work [J]"].back();
    const auto  &remainder = table["energy remainder [J]"];
    std::cout << "landslide, " << name << ": momentum " << momentum_error(table)
              << ", remainder/final gravity work from "
              << *std::min_element(remainder.begin(), remainder.end()) / work
              << " to " << largest(remainder) / work << ", rest at "
              << time_of_rest(table) << " s, force/weight - 1 "
              << force_imbalance(table) << ", height "
              << table["height [m]"].back() << " m, front "
              << table["front x [m]"].back() << " m, centre "
              << table["centre x [m]"].back() << " m, points "
              << table["points"].back() << ", empty cells at most "
              << largest(table["empty interior cells"]) << ", bodies at most "
              << largest(table["connected bodies"]) << ", ledger "
              << largest(table["split ledger [-]"]) << '\n';
  }
} // namespace talus::cases

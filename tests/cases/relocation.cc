// SPDX-License-Identifier: LGPL-2.1-or-later
// A point that is too far outside a wall. No run gets there: the velocity of
// the boundary nodes is zero along the normal and the boxes reach half a cell,
// so that a point stops short of h/2. The check is called by hand.

#include "case.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <iostream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// What is said when point 0 of the bar is @p outside of the wall at x = 0,
  /// in cells; nothing if that is allowed.
  std::string
  error(const double outside)
  {
    Case<2>       bar("bar.prm", {});
    Points<2>     points = bar.points();
    Relocation<2> relocation;
    relocation.allow_outside({{0.5, 0., 0.5, 0.5}});
    points.data(points.position)[0] = -outside * 0.5;
    try
      {
        relocation.rebuild(points, bar->state().grid);
      }
    catch (const ExcPoint &exception)
      {
        std::ostringstream message;
        exception.print_info(message);
        return message.str();
      }
    return "";
  }
} // namespace



TEST(PointBeyondAWall, IsNamedWithPlaceAndCure)
{
  EXPECT_EQ(error(0.499), "");
  const std::string message = error(0.501);
  std::cout << message;
  for (const std::string words :
       {"Point ", "'Left'", "(-0.2505", "0.25 m are allowed", "CFL number"})
    EXPECT_NE(message.find(words), std::string::npos) << words;
}

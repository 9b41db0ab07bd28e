// SPDX-License-Identifier: LGPL-2.1-or-later
// Friction of surfaces that soften by slip.

#include <talus/boundaries/interface_friction.h>

#include "core_setup.h"

namespace interface_friction_test
{
  using namespace talus;

  struct Interface : FreshParameters
  {
    explicit Interface(const std::string &entries)
      : friction("/Bed")
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        in_section("Bed", entries));
      ParameterAcceptor::parse_all_parameters();
    }

    InterfaceFriction friction;
  };

  const std::string softens = "set Slip to remould = 0.1\n"
                              "set Remoulded shear stress ratio = 0.4";



  /// tau_max/tau_p after the slip @p s, m.
  double
  share(const double s)
  {
    return 0.4 + 0.6 * std::exp(-30. * s);
  }
} // namespace interface_friction_test



TEST(SofteningSurface, CapFallsWithSlip)
{
  using namespace interface_friction_test;
  Interface surface(softens);
  surface.friction.check();
  surface.friction.scale_strength(0.5);
  for (const double before : {0., 0.02, 0.3})
    for (const double further : {0., 0.01, 1.})
      {
        const CoulombLimit limit = surface.friction.limit(1000., 2., {before});
        EXPECT_NEAR(limit.force(1e9, further),
                    0.5 * 2000. * share(before + further),
                    1e-10);
        const double ds = 1e-6;
        EXPECT_NEAR(limit.slope(1e9, further + ds),
                    (limit.force(1e9, further + 2. * ds) -
                     limit.force(1e9, further)) /
                      (2. * ds),
                    1e-4);
        // Less normal force than the cap needs: Coulomb friction.
        EXPECT_DOUBLE_EQ(limit.force(10., further), 0.5 * 10. * 10.);
        EXPECT_EQ(limit.slope(10., further), 0.);
      }
}



// 95 % of the loss has happened after the slip to remould.
TEST(SofteningSurface, SlipToRemould)
{
  using namespace interface_friction_test;
  const Interface surface(softens);
  EXPECT_NEAR((1. - surface.friction.share_after_slip(0.1)) / 0.6, 0.95, 3e-4);
}



TEST(SofteningSurface, TriggerIsASmallerShareAndNoProduct)
{
  using namespace interface_friction_test;
  Interface surface(softens);
  surface.friction.scale_triggered_region(0.7);
  const auto cap = [&](const double s, const bool is_triggered) {
    return surface.friction.limit(1000., 1., {s, is_triggered}).force(1e9);
  };
  EXPECT_DOUBLE_EQ(cap(0., true), 700.);
  EXPECT_DOUBLE_EQ(cap(0., false), 1000.);
  EXPECT_DOUBLE_EQ(cap(0.001, true), 700.);
  EXPECT_DOUBLE_EQ(cap(0.1, true), 1000. * share(0.1));
  EXPECT_DOUBLE_EQ(cap(0.1, false), 1000. * share(0.1));
  // Slip within a load step, from above the fraction of the trigger to below.
  const CoulombLimit limit = surface.friction.limit(1000., 1., {0.001, true});
  EXPECT_DOUBLE_EQ(limit.force(1e9, 0.001), 700.);
  EXPECT_EQ(limit.slope(1e9, 0.001), 0.);
  EXPECT_NEAR(limit.force(1e9, 0.1), 1000. * share(0.101), 1e-10);
  // Without a region the fraction multiplies.
  surface.friction.scale_shear_stress(0.7);
  EXPECT_DOUBLE_EQ(cap(0.1, false), 700. * share(0.1));
}



TEST(SofteningSurface, ContradictionsAreRefused)
{
  using namespace interface_friction_test;
  for (const std::string entries :
       {"set Slip to remould = 0.1", "set Remoulded shear stress ratio = 0.5"})
    {
      const Interface surface(entries);
      EXPECT_TRUE(
        contains(message_of<ExcUser>([&]() { surface.friction.check(); }),
                 "Give both or neither"))
        << entries;
    }
}

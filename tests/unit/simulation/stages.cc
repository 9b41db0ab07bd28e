// SPDX-License-Identifier: LGPL-2.1-or-later
// What a run consists of.

#include <talus/simulation/stages.h>

#include "core_setup.h"

namespace
{
  using namespace talus;

  struct ListedStages : FreshParameters, Stages
  {
    explicit ListedStages(const std::string &list)
    {
      auto &prm = dealii::ParameterAcceptor::prm;
      dealii::ParameterAcceptor::declare_all_parameters();
      prm.parse_input_from_string("set Stages = " + list + "\n");
      dealii::ParameterAcceptor::parse_all_parameters();
      check();
    }
  };



  std::string
  complaint_about(const std::string &list)
  {
    return message_of<ExcUser>([&]() { ListedStages stages(list); });
  }



  TEST(StagesTest, RunOneAfterTheOther)
  {
    ListedStages stages("equilibrium, strength reduction, dynamics");
    EXPECT_TRUE(stages.has_static());
    EXPECT_EQ(stages.number(), 1u);
    EXPECT_EQ(stages.next(), Stage::equilibrium);
    stages.mark_done();
    EXPECT_TRUE(stages.next_is_static());
    EXPECT_EQ(stages.next(), Stage::strength_reduction);
    stages.mark_done();
    EXPECT_FALSE(stages.next_is_static());
    EXPECT_TRUE(stages.contain(Stage::dynamics));
  }



  TEST(StagesTest, StaticOnly)
  {
    ListedStages stages("strength reduction");
    EXPECT_FALSE(stages.contain(Stage::dynamics));
    EXPECT_FALSE(stages.contain(Stage::equilibrium));
    stages.mark_done();
    EXPECT_FALSE(stages.next_is_static());
  }



  TEST(StagesTest, WrongListsAreRefused)
  {
    EXPECT_FALSE(ListedStages("dynamics").has_static());
    EXPECT_TRUE(contains(complaint_about("equilibrium, rest"),
                         "Stages lists 'rest', but the stages are "
                         "'equilibrium', 'strength reduction' and "
                         "'dynamics'."));
    EXPECT_TRUE(contains(complaint_about("dynamics, equilibrium"),
                         "Stages lists 'equilibrium' after 'dynamics'."));
    EXPECT_TRUE(contains(complaint_about("equilibrium, equilibrium"),
                         "Give each stage once at most"));
    EXPECT_TRUE(contains(complaint_about(""), "there is nothing to do"));
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
// The log tells whether drained or undrained is right.

#include <talus/problem/drainage.h>

#include "../whole_problem.h"

#include <gtest/gtest.h>

namespace drainage_test
{
  struct Nothing
  {};



  /// Remarks on soil 1 m thick in cells of 0.5 m after 100 s.
  std::vector<talus::Remark>
  remarks(const std::string &pore_water)
  {
    WholeProblem<Nothing> soil(
      "",
      in_section("Materials",
                 in_section("clay", in_section("Pore water", pore_water))));
    return talus::notes_on_drainage(soil.problem.materials,
                                    soil.problem.bodies().thickness(),
                                    100.);
  }
} // namespace drainage_test



// E = 1 MPa and nu = 0.3: K = E/1.2, K_f/K = 21.923 and B = 0.9564.
TEST(Drainage, WayAndStiffnessOfTheWater)
{
  using namespace drainage_test;
  EXPECT_TRUE(remarks("").empty());
  struct Row
  {
    std::string c_v, way, verdict;
  };
  const std::string neither = ": neither drained nor undrained is right";
  for (const auto &[c_v, way, verdict] :
       {Row{"2.25e-3", "0.474", ": undrained is right"},
        Row{"2.56e-3", "0.506", neither},
        Row{"0.0099", "0.995", neither},
        Row{"0.0101", "1", ": drained is right"}})
    for (const std::string drainage : {"drained", "undrained"})
      {
        const auto notes =
          remarks("set Drainage = " + drainage +
                  "\nset Coefficient of consolidation = " + c_v);
        ASSERT_EQ(notes.size(), drainage == "drained" ? 1u : 2u);
        if (drainage == "undrained")
          {
            EXPECT_TRUE(contains(notes[0].sentence, "K_f of 1.827e+07 Pa") &&
                        contains(notes[0].sentence, "B is 0.9564"))
              << notes[0].sentence;
          }
        const talus::Remark &note = notes.back();
        EXPECT_TRUE(contains(note.sentence, "water moves " + way + " m") &&
                    contains(note.sentence, verdict))
          << note.sentence;
        EXPECT_EQ(note.severity == talus::Severity::information,
                  verdict == ": " + drainage + " is right")
          << note.sentence;
      }
}

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/stages.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    const std::vector<std::string> stage_names = {"equilibrium",
                                                  "strength reduction",
                                                  "dynamics"};
  }



  Stages::Stages()
    : ParameterAcceptor("/")
  {
    add_parameter("Stages",
                  names_,
                  "Stages of the run, in this order, separated by commas: "
                  "'equilibrium' brings the soil into static balance with the "
                  "weight; 'strength reduction' finds the factor of safety and "
                  "leaves the soil unchanged; 'dynamics' computes the motion "
                  "of the soil up to the end time.");
  }



  /// Each stage starts from the result of the previous stage, so only the order
  /// of the enumeration is meaningful. Stages may be omitted.
  void
  Stages::check()
  {
    stages_.clear();
    for (const std::string &name : names_)
      {
        const auto found =
          std::find(stage_names.begin(), stage_names.end(), name);
        AssertThrow(found != stage_names.end(),
                    ExcUser(text("Stages lists '",
                                 name,
                                 "', but the stages are 'equilibrium', "
                                 "'strength reduction' and 'dynamics'.")));
        const auto stage = static_cast<Stage>(found - stage_names.begin());
        AssertThrow(stages_.empty() || stages_.back() < stage,
                    ExcUser(
                      text("Stages lists '",
                           name,
                           "' after '",
                           stage_names[static_cast<int>(stages_.back())],
                           "'. Give each stage once at most, in the order "
                           "equilibrium, strength reduction, "
                           "dynamics.")));
        stages_.push_back(stage);
      }
    AssertThrow(!stages_.empty(),
                ExcUser("Stages is empty, so that there is nothing to do. Give "
                        "'dynamics', or 'equilibrium, dynamics'."));
  }



  bool
  Stages::contain(const Stage stage) const
  {
    return std::find(stages_.begin(), stages_.end(), stage) != stages_.end();
  }



  /// Finished stages are not run again. The list of stages is a parameter.
  void
  Stages::list_state(StateList &list)
  {
    list.add("static stages done", "-", n_done_, Reduction::equal);
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_stages_h
#define talus_simulation_stages_h

#include <talus/base/state_list.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// Stages of a run, in order of execution.
  enum class Stage
  {
    equilibrium,        ///< static balance of the soil
    strength_reduction, ///< search for the factor of safety
    dynamics            ///< motion of the soil, to the end time
  };



  /// Stages of a run, and the number of stages done.
  class Stages : public dealii::ParameterAcceptor
  {
  public:
    Stages();

    /// Throw ExcUser unless each stage is listed at most once, in the order of
    /// Stage. Call after parsing.
    void
    check();

    bool
    contain(Stage stage) const;

    bool
    has_static() const
    {
      return stages_.front() != Stage::dynamics;
    }

    /// Return whether the next stage is static.
    bool
    next_is_static() const
    {
      return n_done_ < stages_.size() && stages_[n_done_] != Stage::dynamics;
    }

    /// Return whether the dynamics follows the next stage.
    bool
    next_precedes_dynamics() const
    {
      return n_done_ + 1 < stages_.size() &&
             stages_[n_done_ + 1] == Stage::dynamics;
    }

    Stage
    next() const
    {
      return stages_[n_done_];
    }

    /// One-based number of the next stage.
    unsigned int
    number() const
    {
      return n_done_ + 1;
    }

    void
    mark_done()
    {
      ++n_done_;
    }

    void
    list_state(StateList &list);

  private:
    std::vector<std::string> names_ = {"dynamics"};
    std::vector<Stage>       stages_;
    unsigned int             n_done_ = 0;
  };
} // namespace talus

#endif

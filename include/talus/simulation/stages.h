// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_stages_h
#define talus_simulation_stages_h

#include <talus/base/state.h>

#include <deal.II/base/parameter_acceptor.h>

#include <string>
#include <vector>

namespace talus
{
  /// What a run does, one after the other.
  enum class Stage
  {
    equilibrium,        ///< brings the soil into balance
    strength_reduction, ///< finds the factor of safety
    dynamics            ///< lets it go, to the end time
  };



  /// The stages of a run and how many of them are done.
  class Stages : public dealii::ParameterAcceptor
  {
  public:
    Stages();

    /// To be called after parsing. Throws ExcUser unless each stage is listed
    /// once at most, in the order of Stage.
    void
    check();

    bool
    contain(Stage stage) const;

    bool
    have_static() const
    {
      return stages_.front() != Stage::dynamics;
    }

    /// Whether the next one is of those that stand still.
    bool
    next_is_static() const
    {
      return n_done_ < stages_.size() && stages_[n_done_] != Stage::dynamics;
    }

    /// Whether no other static stage comes after the next one, so that a run may
    /// go on with the dynamics from there, now or when it is resumed.
    bool
    next_is_last_static() const
    {
      return n_done_ + 1 >= stages_.size() ||
             stages_[n_done_ + 1] == Stage::dynamics;
    }

    Stage
    next() const
    {
      return stages_[n_done_];
    }

    /// From 1.
    unsigned int
    number() const
    {
      return n_done_ + 1;
    }

    void
    count_one()
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_remark_observer_h
#define talus_simulation_remark_observer_h

#include <talus/io/log.h>
#include <talus/observers/observer.h>

#include <string>

namespace talus
{
  /// Writes a remark to the log, once per run, as soon as there is a reason.
  /// Checked when a row of statistics is due. A derived class knows reason and
  /// sentence.
  template <int dim>
  class RemarkObserver : public Observer<dim>
  {
  public:
    /// @p name identifies the remark in checkpoints.
    RemarkObserver(const std::string &name, Log &log)
      : name_(name)
      , log_(log)
    {}

    /// Do nothing: the log is open.
    void
    begin(const OutputSettings & /*settings*/,
          const State<dim> & /*state*/,
          const Beginning /*beginning*/) override
    {}

    void
    observe(const State<dim> &state) override
    {
      if (is_written_)
        return;
      const Remark found = remark(state);
      is_written_        = !found.sentence.empty();
      if (is_written_)
        log_.remark(found);
    }

    /// Add whether the remark was written: a resumed run does not repeat it.
    void
    list_state(StateList &list) override
    {
      list.add(name_, "-", is_written_, Reduction::equal);
    }

    /// Do nothing: the log is not a result.
    void
    sync() override
    {}

  private:
    /// Return the remark, empty on all ranks if there is no reason. Collective.
    virtual Remark
    remark(const State<dim> &state) const = 0;

    std::string name_;
    Log        &log_;
    bool        is_written_ = false;
  };
} // namespace talus

#endif

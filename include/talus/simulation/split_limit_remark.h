// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_split_limit_remark_h
#define talus_simulation_split_limit_remark_h

#include <talus/adaptivity/splitter.h>
#include <talus/io/log.h>
#include <talus/observers/observer.h>

namespace talus
{
  /// Writes a remark to the log when points that are stretched too far are not
  /// split for the first time in a run, since a limit of the splitter forbids
  /// it: soil may tear there. Looks when a row of statistics is due. Points
  /// that are shorter than `Minimum length` are no reason for the remark: their
  /// boxes fit into their cells.
  template <int dim>
  class SplitLimitRemark : public Observer<dim>
  {
  public:
    SplitLimitRemark(const Splitter<dim> &splitter, Log &log);

    /// Do nothing: the log is open.
    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    /// Write the remark, if there is a reason for the first time. Collective.
    void
    observe(const State<dim> &state) override;

    /// Add whether the remark was written: a resumed run does not repeat it.
    void
    list_state(StateList &list) override;

    /// Do nothing: the log is no result.
    void
    sync() override;

  private:
    const Splitter<dim> &splitter_;
    Log                 &log_;
    bool                 is_written_ = false;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_split_limit_remark_h
#define talus_simulation_split_limit_remark_h

#include <talus/adaptivity/splitter.h>
#include <talus/io/log.h>
#include <talus/observers/observer.h>

namespace talus
{
  /// Writes a remark to the log, once per run, when a limit of the splitter
  /// prevents the split of overstretched points: soil may tear there. Checked
  /// when a row of statistics is due. Points shorter than `Minimum length` do
  /// not count, because the boxes fit into the cells.
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

    /// Write the remark when points are prevented from splitting for the first
    /// time. Collective.
    void
    observe(const State<dim> &state) override;

    /// Add whether the remark was written: a resumed run does not repeat the
    /// remark.
    void
    list_state(StateList &list) override;

    /// Do nothing: the log is not a result.
    void
    sync() override;

  private:
    const Splitter<dim> &splitter_;
    Log                 &log_;
    bool                 is_written_ = false;
  };
} // namespace talus

#endif

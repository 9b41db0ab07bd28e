// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_split_limit_remark_h
#define talus_simulation_split_limit_remark_h

#include <talus/adaptivity/splitter.h>
#include <talus/simulation/remark_observer.h>

namespace talus
{
  /// Writes a remark to the log, once per run, when a limit of the splitter
  /// prevents the split of more than a thousandth of the points: soil may tear
  /// there. Checked when a row of statistics is due. Points shorter than
  /// `Minimum length` do not count, because the boxes fit into the cells.
  template <int dim>
  class SplitLimitRemark : public RemarkObserver<dim>
  {
  public:
    SplitLimitRemark(const Splitter<dim> &splitter, Log &log)
      : RemarkObserver<dim>("split limit remark", log)
      , splitter_(splitter)
    {}

  private:
    Remark
    remark(const State<dim> &state) const override;

    const Splitter<dim> &splitter_;
  };
} // namespace talus

#endif

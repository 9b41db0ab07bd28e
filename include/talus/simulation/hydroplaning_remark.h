// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_hydroplaning_remark_h
#define talus_simulation_hydroplaning_remark_h

#include <talus/simulation/remark_observer.h>
#include <talus/water/hydroplaning.h>

namespace talus
{
  /// Says when and where the rule of hydroplaning acts first. Checked when a
  /// row of statistics is due.
  template <int dim>
  class HydroplaningRemark : public RemarkObserver<dim>
  {
  public:
    HydroplaningRemark(const Hydroplaning<dim> &rule, Log &log)
      : RemarkObserver<dim>("hydroplaning remark", log)
      , rule_(rule)
    {}

    void
    list_state(StateList &list) override
    {
      if (rule_.is_enabled())
        RemarkObserver<dim>::list_state(list);
    }

  private:
    Remark
    remark(const State<dim> &state) const override
    {
      return rule_.report(state);
    }

    const Hydroplaning<dim> &rule_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_run_remarks_h
#define talus_simulation_run_remarks_h

#include <talus/adaptivity/splitter.h>
#include <talus/base/quantity.h>
#include <talus/io/log.h>
#include <talus/materials/materials.h>
#include <talus/observers/observer.h>

#include <functional>
#include <string>
#include <vector>

namespace talus
{
  /// Writes remarks to the log, each once per run, as soon as there is a
  /// reason. Checked when a row of statistics is due.
  template <int dim>
  class RunRemarks : public Observer<dim>
  {
  public:
    /// Returns the remark, empty on all ranks if there is no reason.
    /// Collective.
    using Reason = std::function<Remark(const State<dim> &)>;

    explicit RunRemarks(Log &log)
      : log_(log)
    {}

    /// Add a remark. @p name identifies the remark in checkpoints.
    void
    add(const std::string &name, const Reason &reason)
    {
      rows_.push_back({name, reason, false});
    }

    /// Do nothing: the log is open.
    void
    begin(const OutputSettings & /*settings*/,
          const State<dim> & /*state*/,
          const Beginning /*beginning*/) override
    {}

    void
    observe(const State<dim> &state) override;

    /// Add which remarks were written: a resumed run does not repeat them.
    void
    list_state(StateList &list) override;

    /// Do nothing: the log is not a result.
    void
    sync() override
    {}

  private:
    struct Row
    {
      std::string name;
      Reason      reason;
      bool        is_written;
    };

    std::vector<Row> rows_;
    Log             &log_;
  };



  /// Remark that a limit of the splitter prevents the split of more than a
  /// thousandth of the points: soil may tear there. Points shorter than
  /// `Minimum length` do not count, because the boxes fit into the cells.
  template <int dim>
  Remark
  remark_on_split_limits(const State<dim>    &state,
                         const Splitter<dim> &splitter);

  /// Remark that soil does not touch the ground below: the contact area
  /// differs from the footprint by more than a twentieth. @p areas has both,
  /// as listed by list_contact_area().
  Remark
  remark_on_contact_area(double time, const Quantities &areas);

  /// Remark that plastic soil moves faster than 0.45 times the speed of the
  /// waves in it, so that impacts compress the soil. Collective.
  template <int dim>
  Remark
  remark_on_speed(const State<dim> &state, const Materials<dim> &materials);
} // namespace talus

#endif

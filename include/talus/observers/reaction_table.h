// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_reaction_table_h
#define talus_observers_reaction_table_h

#include <talus/observers/quantity_table.h>
#include <talus/observers/reaction_interval.h>

#include <string>
#include <vector>

namespace talus
{
  /// Table of the forces of the soil on surfaces, one row per interval of the
  /// statistics: means and extremes over all steps since the previous row;
  /// impulses and works since the start. A derived class names the surfaces.
  template <int dim>
  class ReactionTable : public QuantityTable<dim>
  {
  public:
    using QuantityTable<dim>::QuantityTable;

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning) override;

    void
    follow(const State<dim> &state) override;

    void
    observe(const State<dim> &state) override;

    /// Add the intervals to the state of the run, unless there are no surfaces.
    void
    list_state(StateList &list) override;

  protected:
    /// Append the columns of surface @p k.
    void
    list_reaction(unsigned int k, Quantities &row) const;

  private:
    /// Return one reaction per surface, none if the table is disabled.
    virtual const std::vector<Reaction<dim>> &
    reactions() const = 0;

    /// Name of surface @p k, and kind of surface: both in the names of
    /// checkpoint entries.
    virtual const std::string &
    name(unsigned int k) const = 0;
    virtual std::string
    kind() const = 0;

    std::vector<ReactionInterval<dim>> intervals_;
    double                             averaging_time_ = 0; ///< s
  };
} // namespace talus

#endif

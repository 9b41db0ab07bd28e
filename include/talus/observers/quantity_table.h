// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_quantity_table_h
#define talus_observers_quantity_table_h

#include <talus/base/quantity.h>
#include <talus/observers/table_observer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Table with one row per output time. Names and values come from the same
  /// list, so header and rows always agree.
  template <int dim>
  class QuantityTable : public TableObserver<dim>
  {
  public:
    using TableObserver<dim>::TableObserver;

    /// Quantities of a row, in the order of the columns; valid on the first
    /// rank. Collective.
    virtual Quantities
    evaluate(const State<dim> &state) const = 0;

    void
    observe(const State<dim> &state) override
    {
      std::vector<double> values;
      for (const Quantity &quantity : evaluate(state))
        values.push_back(quantity.value);
      this->add_rows(state, {values});
    }

  private:
    // The values are discarded; called once per run.
    std::vector<std::string>
    columns(const OutputSettings & /*settings*/,
            const State<dim> &state) const override
    {
      std::vector<std::string> result;
      for (const Quantity &quantity : evaluate(state))
        result.push_back(quantity.heading());
      return result;
    }
  };
} // namespace talus

#endif

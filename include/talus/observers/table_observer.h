// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_table_observer_h
#define talus_observers_table_observer_h

#include <talus/observers/observer.h>

#include <string>
#include <vector>

namespace talus
{
  /// Observer with a table, a CSV file written by the first rank. A derived
  /// class provides columns and rows.
  template <int dim>
  class TableObserver : public Observer<dim>
  {
  public:
    explicit TableObserver(const std::string &file_name)
      : file_name_(file_name)
    {}

    void
    begin(const OutputSettings &settings,
          const State<dim>     &state,
          Beginning             beginning = Beginning::fresh) override;

    void
    list_state(StateList &list) override;

    std::string
    cannot_resume(const OutputSettings &settings,
                  const State<dim>     &state) const override;

    void
    sync() override;

  protected:
    /// Append the rows of the current output time, given on the first rank.
    void
    add_rows(const State<dim>                       &state,
             const std::vector<std::vector<double>> &rows);

  private:
    /// Names of the columns; collective.
    virtual std::vector<std::string>
    columns(const OutputSettings &settings, const State<dim> &state) const = 0;

    std::string file_name_;
    CsvFile     file_;
  };
} // namespace talus

#endif

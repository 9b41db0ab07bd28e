// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_table_observer_h
#define talus_observers_table_observer_h

#include <talus/base/agreement.h>
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
          const Beginning       beginning = Beginning::fresh) override
    {
      // All ranks evaluate the names, which may need communication; likewise in
      // cannot_resume().
      const std::vector<std::string> names = columns(settings, state);
      if (is_first_rank(state.communicator()))
        file_.open(settings.folder / file_name_, names, beginning);
    }

    void
    list_state(StateList &list) override
    {
      file_.list_state(file_name_, list);
    }

    std::string
    cannot_resume(const OutputSettings &settings,
                  const State<dim>     &state) const override
    {
      const std::vector<std::string> names = columns(settings, state);
      return is_first_rank(state.communicator())
               ? file_.cannot_resume(settings.folder / file_name_, names)
               : "";
    }

    void
    sync() override
    {
      file_.sync();
    }

  protected:
    /// Append the rows of the current output time, given on the first rank.
    void
    add_rows(const State<dim>                       &state,
             const std::vector<std::vector<double>> &rows)
    {
      // Flush the rows, so that the table can be read during the run.
      if (!is_first_rank(state.communicator()))
        return;
      for (const std::vector<double> &row : rows)
        file_.add_row(row);
      file_.flush();
    }

  private:
    /// Names of the columns; collective.
    virtual std::vector<std::string>
    columns(const OutputSettings &settings, const State<dim> &state) const = 0;

    std::string file_name_;
    CsvFile     file_;
  };
} // namespace talus

#endif

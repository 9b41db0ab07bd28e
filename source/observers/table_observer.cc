// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/observers/table_observer.h>

namespace talus
{
  /// All ranks evaluate the names, which may need communication; likewise in
  /// cannot_resume().
  template <int dim>
  void
  TableObserver<dim>::begin(const OutputSettings &settings,
                            const State<dim>     &state,
                            const Beginning       beginning)
  {
    const std::vector<std::string> names = columns(settings, state);
    if (is_first_rank(state.communicator()))
      file_.open(settings.folder / file_name_, names, beginning);
  }



  template <int dim>
  void
  TableObserver<dim>::list_state(StateList &list)
  {
    file_.list_state(file_name_, list);
  }



  template <int dim>
  std::string
  TableObserver<dim>::cannot_resume(const OutputSettings &settings,
                                    const State<dim>     &state) const
  {
    const std::vector<std::string> names = columns(settings, state);
    return is_first_rank(state.communicator())
             ? file_.cannot_resume(settings.folder / file_name_, names)
             : "";
  }



  template <int dim>
  void
  TableObserver<dim>::sync()
  {
    if (is_first_rank(MPI_COMM_WORLD))
      file_.sync();
  }



  /// Flush the rows, so that the table can be read during the run.
  template <int dim>
  void
  TableObserver<dim>::add_rows(const State<dim>                       &state,
                               const std::vector<std::vector<double>> &rows)
  {
    if (!is_first_rank(state.communicator()))
      return;
    for (const std::vector<double> &row : rows)
      file_.add_row(row);
    file_.flush();
  }



  template class TableObserver<2>;
  template class TableObserver<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/newton_table.h>

namespace talus
{
  namespace
  {
    const std::vector<std::string> newton_columns = {"stage",
                                                     "strength factor [-]",
                                                     "load step",
                                                     "load [-]",
                                                     "iteration",
                                                     "residual [-]",
                                                     "step length [-]",
                                                     "linear iterations"};
  }



  void
  NewtonTable::begin(const std::filesystem::path &folder,
                     const Beginning              beginning)
  {
    folder_ = folder;
    file_.open(folder / file_name, newton_columns, beginning);
  }



  std::uintmax_t
  NewtonTable::length() const
  {
    return std::filesystem::file_size(folder_ / file_name);
  }



  /// Implemented as a resume from a checkpoint with the given length.
  void
  NewtonTable::cut(const std::uintmax_t length)
  {
    StateList list;
    file_.list_state(file_name, list);
    list.numbers().front().set(length);
    begin(folder_, Beginning::resumed);
  }



  std::string
  NewtonTable::cannot_resume(const std::filesystem::path &folder) const
  {
    return file_.cannot_resume(folder / file_name, newton_columns);
  }



  /// Each row is flushed, so a failing search can be followed while running.
  /// Integers are stored as doubles, as in all tables.
  void
  NewtonTable::add(const unsigned int         stage,
                   const double               factor,
                   const EquilibriumProgress &progress)
  {
    const NewtonIteration &iteration = progress.iteration;
    file_.add_row({1. * stage,
                   factor,
                   1. * progress.load_step,
                   progress.load,
                   1. * iteration.number,
                   iteration.residual,
                   iteration.length,
                   1. * iteration.n_linear_iterations});
    file_.flush();
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/newton_table.h>

#include <iomanip>

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
  NewtonTable::add(const SearchLabel         &label,
                   const EquilibriumProgress &progress,
                   const bool                 is_first_rank)
  {
    const NewtonIteration &iteration = progress.iteration;
    if (iteration.number == 0)
      residuals_.clear(); // after a cut, or a change at the seabed
    last_ = progress;
    residuals_.push_back(iteration.residual);
    n_linear_iterations_ += iteration.n_linear_iterations;
    seconds_ += iteration.seconds;
    if (!is_first_rank)
      return;
    file_.add_row({1. * label.stage,
                   label.strength_factor,
                   1. * progress.load_step,
                   progress.load,
                   1. * iteration.number,
                   iteration.residual,
                   iteration.length,
                   1. * iteration.n_linear_iterations});
    file_.flush();
  }



  /// The residuals show whether convergence was quadratic.
  void
  NewtonTable::end_step(const SearchLabel &label)
  {
    std::string residuals;
    for (const double residual : residuals_)
      residuals +=
        text(residuals.empty() ? "" : ", ", std::setprecision(2), residual);
    if (!label.is_trial && !residuals.empty())
      log_.say(LogLevel::result,
               text(std::setprecision(6),
                    "  step ",
                    last_.load_step,
                    ", load ",
                    last_.load,
                    ": residuals ",
                    residuals,
                    n_linear_iterations_ > 0
                      ? text("; ", n_linear_iterations_, " linear iterations")
                      : std::string(),
                    ", ",
                    seconds_,
                    " s"));
    residuals_.clear();
    n_linear_iterations_ = 0;
    seconds_             = 0;
  }
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/io/input_file.h>
#include <talus/problem/ground_motion.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  GroundMotion<dim>::GroundMotion(const std::filesystem::path &folder)
    : ParameterAcceptor("/Ground motion")
    , folder_(folder)
  {
    add_parameter("File",
                  file_,
                  "CSV file with the motion of the ground in time, with a "
                  "path from the folder of the parameter file; empty for "
                  "none. The first line names the columns: 'time [s]' and "
                  "any of 'horizontal [m/s^2]' (acceleration of the ground, "
                  "positive down the slope), 'vertical [m/s^2]' (upwards), "
                  "in 3-D 'across [m/s^2]' (along z), and 'gravity factor "
                  "[-]' (multiplier of gravity). Linear between the rows; "
                  "before and after the rows accelerations are zero and "
                  "gravity is constant.");
    add_parameter("Start time",
                  start_time_,
                  "Time of the run at which the time of the table is zero "
                  "[s].",
                  this->prm,
                  Patterns::Double());
    add_parameter("Factor",
                  factor_,
                  "Multiplier of the accelerations of the table [-], to "
                  "scale a record.",
                  this->prm,
                  Patterns::Double());
  }



  namespace
  {
    /// Throw ExcUser if a column of accelerations has no effect, or lets the
    /// ground jump into motion at time @p begin of the run, s, with the first
    /// value @p first.
    void
    check_accelerations(const std::string           &column,
                        const double                 factor,
                        const double                 begin,
                        const double                 first,
                        const std::filesystem::path &table)
    {
      AssertThrow(factor != 0.,
                  ExcUser(
                    "'Ground motion/Factor' is 0: the accelerations of the "
                    "table '" +
                    table.string() +
                    "' have no effect. Give another factor, or remove the "
                    "columns of accelerations."));
      AssertThrow(
        begin <= 0. || first == 0.,
        ExcUser(text("The table '",
                     table.string(),
                     "' begins at t = ",
                     begin,
                     " s of the run with ",
                     factor * first,
                     " m/s^2 in the column '",
                     column,
                     "': the ground would jump into motion. Insert a row with "
                     "zeros before the first row, or let the table begin with "
                     "the run ('Ground motion/Start time').")));
    }
  } // namespace



  /// A table that begins after the start of the run must begin with zeros: the
  /// ground rests outside of the table, and would jump otherwise. The final
  /// acceleration of a table may be nonzero.
  template <int dim>
  void
  GroundMotion<dim>::prepare(const double end_time)
  {
    table_.reset();
    AssertThrow(!file_.empty() || (start_time_ == 0. && factor_ == 1.),
                ExcUser(
                  "The section 'Ground motion' has entries, but 'Ground "
                  "motion/File' is empty, and the ground rests. Give a table "
                  "or remove the section."));
    if (file_.empty())
      return;
    std::vector<std::string>    columns = {"horizontal [m/s^2]",
                                           "vertical [m/s^2]",
                                           "across [m/s^2]",
                                           "gravity factor [-]"};
    const std::filesystem::path path    = folder_ / file_;
    table_ = std::make_unique<TimeTable>(path, columns);
    // A column without effect is an error: the user expects an effect.
    AssertThrow(dim == 3 || !table_->has(across),
                ExcUser("The table '" + path.string() + "' has a column '" +
                        columns[across] +
                        "', but the simulation is two-dimensional. Remove the "
                        "column or set 'Dimension' to 3."));
    // In the time of the run. A table that begins before the run may do so in
    // motion.
    const double begin = start_time_ + table_->first_time();
    for (const Column column : {horizontal, vertical, across})
      if (table_->has(column))
        check_accelerations(columns[column],
                            factor_,
                            begin,
                            table_->value(column, table_->first_time()),
                            path);
    // Gravity is constant outside of the table.
    AssertThrow(table_->has(gravity) ||
                  (begin < end_time && start_time_ + table_->last_time() > 0.),
                ExcUser(text("The table '",
                             path.string(),
                             "' is of t = ",
                             begin,
                             " s to ",
                             start_time_ + table_->last_time(),
                             " s of the run, which goes from 0 to 'End time' "
                             "= ",
                             end_time,
                             " s: it would never act. Correct the table, "
                             "'Ground motion/Start time' or 'End time'.")));
  }



  /// Return the acceleration of the ground, m/s^2, at time @p t of the run.
  /// Zero outside of the table, where interpolation would keep the outermost
  /// value.
  template <int dim>
  double
  GroundMotion<dim>::component(const Column column, const double t) const
  {
    const double s = t - start_time_;
    if (!table_ || !table_->has(column) || s < table_->first_time() ||
        s > table_->last_time())
      return 0.;
    return factor_ * table_->value(column, s);
  }



  /// Records are horizontal and vertical, and the mesh is turned by the slope
  /// angle: a_x = a_h cos - a_v sin and a_y = a_h sin + a_v cos (doc/method.md,
  /// section 11).
  template <int dim>
  Tensor<1, dim>
  GroundMotion<dim>::acceleration(const double t, const double angle) const
  {
    Tensor<1, dim> a;
    if (!table_)
      return a;
    const double a_h = component(horizontal, t), a_v = component(vertical, t);
    a[0] = a_h * std::cos(angle) - a_v * std::sin(angle);
    a[1] = a_h * std::sin(angle) + a_v * std::cos(angle);
    if (dim == 3)
      a[dim - 1] = component(across, t);
    return a;
  }



  /// Unlike accelerations, gravity keeps the outermost values.
  template <int dim>
  double
  GroundMotion<dim>::gravity_factor(const double t) const
  {
    return table_ && table_->has(gravity)
             ? table_->value(gravity, t - start_time_)
             : 1.;
  }



  template <int dim>
  void
  GroundMotion<dim>::list_state(StateList &list) const
  {
    if (table_)
      InputFile{"ground motion", "table", folder_ / file_, table_->checksum()}
        .list_state(list);
  }



  template class GroundMotion<2>;
  template class GroundMotion<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_ground_motion_h
#define talus_problem_ground_motion_h

#include <talus/base/state_list.h>
#include <talus/problem/time_table.h>

#include <deal.II/base/parameter_acceptor.h>
#include <deal.II/base/tensor.h>

#include <memory>
#include <string>

namespace talus
{
  /// Motion of the ground from a table, for instance the record of an
  /// earthquake, and gravity variable in time. The mesh is fixed to the ground:
  /// in the frame of the mesh the soil feels minus the acceleration of the
  /// ground.
  template <int dim>
  class GroundMotion : public dealii::ParameterAcceptor
  {
  public:
    /// Paths of tables start in @p folder.
    explicit GroundMotion(const std::filesystem::path &folder);

    /// Read the table; call after parsing. Throws ExcUser if the table cannot
    /// be used, if the ground would jump into motion in the middle of the run,
    /// or would move only after @p end_time, s.
    void
    prepare(double end_time);

    /// Return the acceleration of the ground at time @p t, s, in m/s^2 along
    /// the axes of a mesh whose x axis points down a slope of @p angle
    /// (radians). Zero before the first and after the last row.
    dealii::Tensor<1, dim>
    acceleration(double t, double angle) const;

    /// Return the multiplier of gravity at time @p t, s [-]: constant before
    /// the first and after the last row.
    double
    gravity_factor(double t) const;

    /// Whether the user has given a table. Call after prepare().
    bool
    has_table() const
    {
      return table_ != nullptr;
    }

    /// Time of the last row of the table in the run, s; 0 without a table.
    double
    last_time() const
    {
      return table_ ? start_time_ + table_->last_time() : 0.;
    }

    /// Add the table, if any, to the state: a resumed run needs the same table.
    void
    list_state(StateList &list) const;

  private:
    /// Columns of the table.
    enum Column
    {
      horizontal,
      vertical,
      across,
      gravity
    };

    double
    component(Column column, double t) const;

    std::filesystem::path      folder_;
    std::string                file_;
    double                     start_time_ = 0.;
    double                     factor_     = 1.;
    std::unique_ptr<TimeTable> table_;
  };
} // namespace talus

#endif

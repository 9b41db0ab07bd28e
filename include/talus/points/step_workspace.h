// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_step_workspace_h
#define talus_points_step_workspace_h

#include <talus/base/assertion.h>
#include <talus/points/points_view.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/exceptions.h>

#include <vector>

namespace talus
{
  /// Temporary quantities of the points of a range, usually a batch, passed
  /// from one phase of a step to the next. Not part of the state: reinit() for
  /// another range makes all values undefined. Rows are indexed by p - begin.
  template <int dim>
  class StepWorkspace
  {
  public:
    /// Assign the workspace to the points [begin, end). Old values are lost.
    void
    reinit(unsigned int begin, unsigned int end);

    /// Free the memory.
    void
    clear();

    WorkspaceView<dim>
    view(const unsigned int begin, const unsigned int end) const
    {
      TalusAssert(begin_ <= begin && end <= end_,
                  dealii::ExcMessage(
                    "The workspace is that of other points: call "
                    "reinit() first."));
      (void)begin;
      (void)end;
      return {const_cast<double *>(memory_.data()), pitch_, begin_};
    }

    /// Velocity gradient dv_i/dx_j after B-bar, 1/s: written by the gather,
    /// read by the stress update of the same step. In load steps of static
    /// stages: displacement gradient [-].
    double *
    velocity_gradient(const unsigned int i, const unsigned int j)
    {
      return row(dim * i + j);
    }

    const double *
    velocity_gradient(const unsigned int i, const unsigned int j) const
    {
      return const_cast<StepWorkspace *>(this)->row(dim * i + j);
    }

    /// Shift of the mean stress to the cell mean (B-bar), Pa.
    double *
    mean_stress_shift()
    {
      return row(dim * dim);
    }

    /// Four scratch rows for use within a phase.
    double *
    scratch(const unsigned int i)
    {
      return row(dim * dim + 1 + i);
    }

    /// Sorted points that may lie outside of the cell of their segment, in any
    /// order, possibly with duplicates. Code that moves points adds them here,
    /// while positions are in registers, for
    /// Relocation::update_points_out_of_cell().
    std::vector<unsigned int> &
    points_out_of_cell()
    {
      return points_out_of_cell_;
    }

    std::size_t
    memory_consumption() const
    {
      return memory_.size() * sizeof(double);
    }

  private:
    static constexpr unsigned int n_rows = dim * dim + 5;

    double *
    row(const unsigned int r)
    {
      return memory_.data() + r * pitch_;
    }

    dealii::AlignedVector<double> memory_;
    std::size_t                   pitch_ = 0;
    unsigned int                  begin_ = 0;
    unsigned int                  end_   = 0;
    std::vector<unsigned int>     points_out_of_cell_;
  };
} // namespace talus

#endif

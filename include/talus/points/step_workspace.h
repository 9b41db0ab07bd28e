// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_points_step_workspace_h
#define talus_points_step_workspace_h

#include <talus/points/points_view.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/exceptions.h>

#include <vector>

namespace talus
{
  /// What a step computes at the points of a range, usually a batch, and the
  /// next phase of the same step reads. No state: undefined once reinit() was
  /// called for other points. Rows are indexed by p - begin.
  template <int dim>
  class StepWorkspace
  {
  public:
    /// Make it that of the points [begin, end). Its content is lost.
    void
    reinit(unsigned int begin, unsigned int end);

    /// Give the memory back.
    void
    clear();

    WorkspaceView<dim>
    view(const unsigned int begin, const unsigned int end) const
    {
      Assert(begin_ <= begin && end <= end_,
             dealii::ExcMessage("The workspace is that of other points: call "
                                "reinit() first."));
      (void)begin;
      (void)end;
      return {const_cast<double *>(memory_.data()), pitch_, begin_};
    }

    /// Velocity gradient after B-bar, dim*dim, 1/s: written by
    /// the gather, read by the stress update of the same step. A load step of
    /// the static stages has its displacement gradient here.
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

    /// Shift of the mean stress to that of the cell (B-bar), Pa.
    double *
    mean_stress_shift()
    {
      return row(dim * dim);
    }

    /// Four rows for what a phase needs within itself.
    double *
    scratch(const unsigned int i)
    {
      return row(dim * dim + 1 + i);
    }

    /// Sorted points that may lie outside the cell of their segment, in any
    /// order, some perhaps twice. Those that move points note them here, while
    /// the positions are at hand, for Relocation::update_points_out_of_cell().
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

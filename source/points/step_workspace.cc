// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>

namespace talus
{
  template <int dim>
  void
  StepWorkspace<dim>::reinit(const unsigned int begin, const unsigned int end)
  {
    begin_ = begin;
    end_   = end;
    // As in Points, rows have space for a whole register behind the last point,
    // and begin at different offsets in a page.
    constexpr std::size_t line = 8;
    const std::size_t     n    = end - begin + Points<dim>::n_spare;
    // Batches differ in size by the rest of the last cell: memory only grows,
    // and after some steps no batch allocates.
    if (pitch_ >= n)
      return;
    pitch_ = (n + line - 1) / line * line + line;
    // Emptied first: resizing would copy the content.
    memory_.resize(0);
    memory_.resize(n_rows * pitch_, 0.);
  }



  template <int dim>
  void
  StepWorkspace<dim>::clear()
  {
    memory_.clear();
    pitch_ = 0;
    begin_ = end_ = 0;
  }



  template class StepWorkspace<2>;
  template class StepWorkspace<3>;
} // namespace talus

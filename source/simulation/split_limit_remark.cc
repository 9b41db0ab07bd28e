// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/split_limit_remark.h>

namespace talus
{
  template <int dim>
  std::string
  SplitLimitRemark<dim>::remark(const State<dim> &state) const
  {
    const UnsplitPoints unsplit =
      splitter_.count_unsplit(state.points,
                              state.grid,
                              state.constants.box_shape.rule);
    if (unsplit.at_generation_limit + unsplit.at_mesh_limit == 0)
      return "";
    return text(
      "At t = ",
      state.time,
      " s points are stretched too far and cannot be split, so "
      "that the soil may tear: ",
      unsplit.at_generation_limit,
      " points have reached 'Splitting/Maximum generation' (raise the "
      "limit, unless the points lie on a base without slip); the children "
      "of ",
      unsplit.at_mesh_limit,
      " points would lie more than half a cell outside the mesh (use a "
      "larger mesh or smaller cells). The columns 'points at ... limit' "
      "of statistics.csv continue the count.");
  }



  template class SplitLimitRemark<2>;
  template class SplitLimitRemark<3>;
} // namespace talus

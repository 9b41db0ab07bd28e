// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/split_limit_remark.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  // Share of the points that is told: a few points among thousands of
  // neighbours leave no gap.
  constexpr double told_share = 1e-3;



  template <int dim>
  Remark
  SplitLimitRemark<dim>::remark(const State<dim> &state) const
  {
    const UnsplitPoints unsplit =
      splitter_.count_unsplit(state.points, state.grid);
    if (unsplit.at_generation_limit + unsplit.at_mesh_limit <=
        told_share *
          Utilities::MPI::sum(state.points.size(), state.communicator()))
      return "";
    std::string why;
    if (unsplit.at_generation_limit > 0)
      why = counted(unsplit.at_generation_limit, "point") +
            " reached 'Splitting/Maximum generation' (raise the limit). ";
    if (unsplit.at_mesh_limit > 0)
      why += counted(unsplit.at_mesh_limit, "point") +
             " would get children more than half a cell outside the mesh (use "
             "a larger mesh or smaller cells). ";
    return text("At t = ",
                state.time,
                " s soil is stretched too far without a split, so that it may "
                "tear: ",
                why,
                "The columns 'points at ... limit' of statistics.csv continue "
                "the count.");
  }



  template class SplitLimitRemark<2>;
  template class SplitLimitRemark<3>;
} // namespace talus

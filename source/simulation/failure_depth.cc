// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/simulation/failure_depth.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // A mechanism that is thinner than so many cells depends on their size.
    constexpr double few_cells = 2.;

    /// Depths of the points that move, and means over those of them that lie
    /// half a cell to one and a half cells below the mudline.
    struct DepthSums
    {
      double depth       = 0; ///< largest, m
      double volume      = 0; ///< of the points of the means, m^dim
      double strength    = 0; ///< times volume, Pa m^dim
      double unit_weight = 0; ///< times volume, N
    };



    std::string
    sentence_on_coarse_cells(const double strength, const double weight)
    {
      return text(std::setprecision(3),
                  " So thin a mechanism depends on the size of the cells: "
                  "halve 'Grid/Cell size' and compare. One cell below the "
                  "mudline the strength of the soil that moves is ",
                  strength,
                  " Pa, ",
                  strength / weight,
                  " of the submerged weight of a cell per area, ",
                  weight,
                  " Pa.");
    }
  } // namespace



  template <int dim>
  void
  FailureDepth<dim>::record(const std::vector<double> &mechanism)
  {
    constexpr double share = 0.3;
    moves_.clear();
    for (std::size_t i = 0; i < mechanism.size(); i += dim)
      moves_.push_back(std::any_of(mechanism.begin() + i,
                                   mechanism.begin() + i + dim,
                                   [](const double component) {
                                     return std::abs(component) > share;
                                   }));
  }



  template <int dim>
  std::string
  FailureDepth<dim>::note(const State<dim>   &state,
                          const Problem<dim> &problem) const
  {
    const Points<dim> &points       = state.points;
    const auto         mudline      = problem.mudline();
    const MPI_Comm     communicator = state.communicator();
    const double       h            = state.grid.finest_size();
    DepthSums          sums;
    for (unsigned int p = 0; p < moves_.size() && mudline; ++p)
      if (moves_[p])
        {
          const auto   x     = load_place(points, points.position, p);
          const double half  = 0.5 * points.data(points.reference_length, 1)[p];
          const double depth = mudline(x) - x[1];
          if (!(depth >= 0.))
            continue;
          sums.depth = std::max(sums.depth, depth + half);
          if (std::abs(depth - h) > 0.5 * h)
            continue;
          const unsigned int body     = points.data(points.body)[p];
          const auto        &material = problem.materials.of_body(body);
          const double       volume   = points.data(points.reference_volume)[p];
          sums.volume += volume;
          sums.strength += volume * material.shear_strength(points, p);
          sums.unit_weight -= volume * material.submerged_density() *
                              problem.loading.gravity()[1];
        }
    sums.depth = Utilities::MPI::max(sums.depth, communicator);
    std::vector<double> means{sums.volume, sums.strength, sums.unit_weight};
    Utilities::MPI::sum(means, communicator, means);
    if (sums.depth == 0.)
      return {};
    const std::string result = text(std::setprecision(3),
                                    "The mechanism reaches ",
                                    sums.depth,
                                    " m below the mudline, ",
                                    sums.depth / h,
                                    " cells.");
    if (sums.depth >= few_cells * h || means[0] == 0.)
      return result;
    return result + sentence_on_coarse_cells(means[1] / means[0],
                                             h * means[2] / means[0]);
  }



  template class FailureDepth<2>;
  template class FailureDepth<3>;
} // namespace talus

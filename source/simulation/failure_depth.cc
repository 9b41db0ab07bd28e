// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/simulation/failure_depth.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iomanip>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // A mechanism thinner than this number of cells depends on the cell size.
    constexpr double few_cells = 2.;

    // Number of layers per cell for counting depths.
    constexpr double parts_of_cell = 4.;

    /// Sums over points, weighted by motion: volume times squared displacement.
    struct MotionSums
    {
      std::vector<double> of_layer; ///< by depth, in parts of a cell
      /// Motion between 0.5 and 1.5 cells below the mudline, and the sums of
      /// motion times strength, Pa, and times unit weight, N/m^dim.
      double motion = 0., strength = 0., unit_weight = 0.;
    };



    /// Sum over all ranks. Collective.
    void
    sum_over_ranks(MotionSums &sums, const MPI_Comm communicator)
    {
      sums.of_layer.resize(
        Utilities::MPI::max(static_cast<unsigned int>(sums.of_layer.size()),
                            communicator));
      Utilities::MPI::sum(sums.of_layer, communicator, sums.of_layer);
      std::vector<double> means{sums.motion, sums.strength, sums.unit_weight};
      Utilities::MPI::sum(means, communicator, means);
      sums.motion      = means[0];
      sums.strength    = means[1];
      sums.unit_weight = means[2];
    }



    /// Number of layers below the mudline that contain nine tenths of the
    /// motion; 0 without motion.
    unsigned int
    n_moving_layers(const std::vector<double> &motion_of_layer)
    {
      double total = 0., above = 0.;
      for (const double motion : motion_of_layer)
        total += motion;
      unsigned int n = 0;
      while (n < motion_of_layer.size() && above < 0.9 * total)
        above += motion_of_layer[n++];
      return n;
    }



    std::string
    sentence_on_coarse_cells(const double strength, const double weight)
    {
      return text(std::setprecision(3),
                  " A mechanism less than two cells thick depends on the size "
                  "of the cells: halve 'Grid/Cell size' and compare. One cell "
                  "below the mudline the strength of the moving soil is ",
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
    square_.assign(mechanism.size() / dim, 0.);
    for (std::size_t i = 0; i < mechanism.size(); ++i)
      square_[i / dim] += mechanism[i] * mechanism[i];
  }



  template <int dim>
  std::string
  FailureDepth<dim>::note(const State<dim>   &state,
                          const Problem<dim> &problem) const
  {
    const Points<dim> &points  = state.points;
    const auto         mudline = problem.bodies().mudline();
    const double       h       = state.grid.finest_size();
    MotionSums         sums;
    for (unsigned int p = 0; p < square_.size() && mudline; ++p)
      {
        const auto   x     = load_place(points, points.position, p);
        const double depth = mudline(x) - x[1];
        if (!(depth >= 0.))
          continue;
        const double motion =
          points.data(points.reference_volume)[p] * square_[p];
        const auto layer = static_cast<unsigned int>(parts_of_cell * depth / h);
        if (layer >= sums.of_layer.size())
          sums.of_layer.resize(layer + 1, 0.);
        sums.of_layer[layer] += motion;
        if (std::abs(depth - h) > 0.5 * h)
          continue;
        const unsigned int body     = points.data(points.body)[p];
        const auto        &material = problem.materials.of_body(body);
        sums.motion += motion;
        sums.strength += motion * material.shear_strength(points, p);
        sums.unit_weight -=
          motion * material.submerged_density() * problem.loading.gravity()[1];
      }
    sum_over_ranks(sums, state.communicator());
    const double n_cells = n_moving_layers(sums.of_layer) / parts_of_cell;
    if (n_cells == 0.)
      return {};
    const std::string result = text(std::setprecision(3),
                                    "Nine tenths of the mechanism lie within ",
                                    n_cells * h,
                                    " m of the mudline, ",
                                    counted(n_cells, "cell"),
                                    ".");
    if (n_cells >= few_cells || sums.motion == 0.)
      return result;
    return result +
           sentence_on_coarse_cells(sums.strength / sums.motion,
                                    h * sums.unit_weight / sums.motion);
  }



  template class FailureDepth<2>;
  template class FailureDepth<3>;
} // namespace talus

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
    // A mechanism thinner than this number of cells depends on the cell size.
    constexpr double few_cells = 2.;

    // Number of layers per cell for counting depths.
    constexpr double parts_of_cell = 4.;

    /// Sums over points, weighted by motion: volume times squared displacement.
    struct MotionSums
    {
      std::vector<double> of_layer;     ///< by depth, in parts of a cell
      std::vector<double> displacement; ///< times volume, by layer
      std::vector<double> volume_of;    ///< by layer
      /// Motion between 0.5 and 1.5 cells below the mudline, and the sums of
      /// motion times strength, Pa, and times unit weight, N/m^dim.
      double motion = 0., strength = 0., unit_weight = 0.;

      /// Add a point of @p volume in @p layer with the square of its
      /// displacement.
      void
      add(const unsigned int layer, const double volume, const double square)
      {
        if (layer >= of_layer.size())
          for (auto *const by_layer : {&of_layer, &displacement, &volume_of})
            by_layer->resize(layer + 1, 0.);
        of_layer[layer] += volume * square;
        displacement[layer] += volume * std::sqrt(square);
        volume_of[layer] += volume;
      }
    };



    /// Sum over all ranks. Collective.
    void
    sum_over_ranks(MotionSums &sums, const MPI_Comm communicator)
    {
      const auto n =
        Utilities::MPI::max(static_cast<unsigned int>(sums.of_layer.size()),
                            communicator);
      for (auto *const by_layer :
           {&sums.of_layer, &sums.displacement, &sums.volume_of})
        {
          by_layer->resize(n);
          Utilities::MPI::sum(*by_layer, communicator, *by_layer);
        }
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



    /// Return the depth of the base of the row of cells that alone shears, in
    /// cells; 0 if the soil slips on a surface, or shears in several rows. The
    /// mean displacement by depth then changes by halves at two rows; slip is
    /// one change, and two rows change it by a quarter, a half and a quarter.
    /// The number of changes is the square of their sum over the sum of their
    /// squares.
    double
    base_of_single_row(const MotionSums &sums)
    {
      double     sum = 0., sum_of_squares = 0., moment = 0., above = 0.;
      const auto n = static_cast<unsigned int>(parts_of_cell);
      for (unsigned int begin = 0; begin < sums.volume_of.size() + n;
           begin += n)
        {
          double displacement = 0., volume = 0.;
          for (unsigned int i = begin;
               i < std::min<std::size_t>(begin + n, sums.volume_of.size());
               ++i)
            {
              displacement += sums.displacement[i];
              volume += sums.volume_of[i];
            }
          const double here   = volume > 0. ? displacement / volume : 0.;
          const double change = begin > 0 ? std::abs(above - here) : 0.;
          sum += change;
          sum_of_squares += change * change;
          moment += change * begin / parts_of_cell;
          above = here;
        }
      const double n_changes = sum > 0. ? sum * sum / sum_of_squares : 0.;
      return n_changes > 1.5 && n_changes < 2.3 ? moment / sum + 0.5 : 0.;
    }



    /// Return a remark on the shear in a row whose base is @p base cells of
    /// size @p h, m, deep, with the factor of safety @p factor. The cells of
    /// the row have the stress of its middle, and the soil at its base a larger
    /// one (doc/method.md, section 12).
    Remark
    remark_on_single_row(const double base, const double h, const double factor)
    {
      return text(
        std::setprecision(4),
        "The soil shears in one row of cells, whose stress is that of "
        "its middle, ",
        (base - 0.5) * h,
        " m below the mudline. If the soil may shear at the base of "
        "the row, ",
        base * h,
        " m deep, the factor of safety is only ",
        factor * (base - 0.5) / base,
        ". Smaller cells approach that number.");
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
  std::vector<Remark>
  FailureDepth<dim>::notes(const State<dim>   &state,
                           const Problem<dim> &problem,
                           const double        factor) const
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
        const double volume = points.data(points.reference_volume)[p];
        sums.add(static_cast<unsigned int>(parts_of_cell * depth / h),
                 volume,
                 square_[p]);
        if (std::abs(depth - h) > 0.5 * h)
          continue;
        const double       motion   = volume * square_[p];
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
    std::vector<Remark> result = {
      text(std::setprecision(3),
           "Nine tenths of the mechanism lie within ",
           n_cells * h,
           " m of the mudline, ",
           counted(n_cells, "cell"),
           ".")};
    if (n_cells < few_cells && sums.motion > 0.)
      result[0].sentence +=
        sentence_on_coarse_cells(sums.strength / sums.motion,
                                 h * sums.unit_weight / sums.motion);
    // Strength that follows the stress grows towards the base as the load does.
    const bool is_given =
      problem.materials.undrained_strength() != numbers::invalid_unsigned_int;
    if (const double base = base_of_single_row(sums); base > 0.5 && is_given)
      result.push_back(remark_on_single_row(base, h, factor));
    return result;
  }



  template class FailureDepth<2>;
  template class FailureDepth<3>;
} // namespace talus

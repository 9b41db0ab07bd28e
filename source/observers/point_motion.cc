// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/point_motion.h>
#include <talus/observers/pore_pressure_ratio.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Sums and extremes over the points.
    template <int dim>
    struct PointSums
    {
      double         n_points = 0;
      double         mass     = 0;      // kg
      Tensor<1, dim> moment;            // kg m
      Tensor<1, dim> momentum;          // kg m/s
      Box<dim>       extent;            // m
      double         maximum_speed = 0; // m/s
    };



    /// Sum over the points of the local rank in a single pass. Extremes start
    /// at the limits of double, so a rank without points does not count.
    template <int dim>
    PointSums<dim>
    sum_over_own_points(const Points<dim> &points)
    {
      PointSums<dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result.extent.lower[d] = std::numeric_limits<double>::max();
          result.extent.upper[d] = std::numeric_limits<double>::lowest();
        }
      result.n_points           = points.size();
      const double *mass        = points.data(points.mass);
      double        top_speed_2 = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          double speed_2 = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double v         = points.data(points.velocity, d)[p];
              const double x         = points.data(points.position, d)[p];
              result.extent.lower[d] = std::min(result.extent.lower[d], x);
              result.extent.upper[d] = std::max(result.extent.upper[d], x);
              result.moment[d] += mass[p] * x;
              result.momentum[d] += mass[p] * v;
              speed_2 += v * v;
            }
          result.mass += mass[p];
          top_speed_2 = std::max(top_speed_2, speed_2);
        }
      result.maximum_speed = std::sqrt(top_speed_2);
      return result;
    }



    /// Sum over the points of all ranks; without points the extent is NaN.
    /// Collective.
    template <int dim>
    PointSums<dim>
    sum_over_points(const Points<dim> &points, const MPI_Comm communicator)
    {
      PointSums<dim> sum = sum_over_own_points(points);
      sum.n_points       = Utilities::MPI::sum(sum.n_points, communicator);
      sum.mass           = Utilities::MPI::sum(sum.mass, communicator);
      sum.moment         = Utilities::MPI::sum(sum.moment, communicator);
      sum.momentum       = Utilities::MPI::sum(sum.momentum, communicator);
      sum.maximum_speed  = Utilities::MPI::max(sum.maximum_speed, communicator);
      for (unsigned int d = 0; d < dim; ++d)
        {
          double &lower = sum.extent.lower[d], &upper = sum.extent.upper[d];
          lower = Utilities::MPI::min(lower, communicator);
          upper = Utilities::MPI::max(upper, communicator);
          if (sum.n_points == 0)
            lower = upper = std::numeric_limits<double>::quiet_NaN();
        }
      return sum;
    }



    /// Maximum height of a point of the local rank above the ground below, m.
    /// Most points are not higher than the maximum so far: the place so far
    /// below them is in the ground.
    template <int dim>
    double
    height_above(const Ground<dim> &ground, const Points<dim> &points)
    {
      double height = std::numeric_limits<double>::lowest();
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const Point<dim> x     = load_place(points, points.position, p);
          Point<dim>       below = x;
          below[1] -= height;
          if (p == 0 || !ground.encloses(below))
            height = std::max(height, x[1] - ground.elevation(x));
        }
      return height;
    }
  } // namespace



  namespace
  {
    struct Share
    {
      double x, mass;
    };



    /// Return the smallest x for which the shares with no larger x have at
    /// least the fraction @p fraction of the mass of all ranks; NaN without
    /// shares. Collective.
    ///
    /// The search needs no sort, and only bin sums travel between ranks. Each
    /// round divides the range of x into 1024 bins, sums the mass by bin over
    /// the ranks, and keeps the shares of the bin in which the cumulative mass
    /// passes the target: three rounds resolve 1e-9 of the range. The search
    /// ends when all remaining shares, over all ranks, have equal x, so the
    /// result is exactly the x of a share and does not depend on their
    /// distribution. mass_below is the mass with x below the range, equal on
    /// all ranks.
    double
    quantile(std::vector<Share> candidates,
             const double       fraction,
             const MPI_Comm     communicator)
    {
      constexpr unsigned int n_bins = 1024;
      double                 mass = 0, mass_below = 0;
      for (const Share &c : candidates)
        mass += c.mass;
      // The tolerance is less than the mass of any point and more than the
      // round-off of the sum: of 200 equal points the 199th always completes
      // 99.5 %.
      const double target =
        (fraction - 1e-12) * Utilities::MPI::sum(mass, communicator);

      while (true)
        {
          double lower = std::numeric_limits<double>::max();
          double upper = std::numeric_limits<double>::lowest();
          for (const Share &c : candidates)
            {
              lower = std::min(lower, c.x);
              upper = std::max(upper, c.x);
            }
          lower = Utilities::MPI::min(lower, communicator);
          upper = Utilities::MPI::max(upper, communicator);
          if (!(lower < upper))
            return lower > upper ? std::numeric_limits<double>::quiet_NaN()
                                 : upper;

          // The largest x would fall in a bin beyond the last.
          const auto bin = [&](const Share &c) {
            const double at = (c.x - lower) / (upper - lower) * n_bins;
            return std::min(n_bins - 1, static_cast<unsigned int>(at));
          };
          std::vector<double> bins(n_bins, 0.);
          for (const Share &c : candidates)
            bins[bin(c)] += c.mass;
          Utilities::MPI::sum(bins, communicator, bins);

          unsigned int b = 0; // by round-off the last one, below the target
          for (; b + 1 < n_bins && mass_below + bins[b] < target; ++b)
            mass_below += bins[b];
          candidates.erase(std::remove_if(candidates.begin(),
                                          candidates.end(),
                                          [&](const Share &c) {
                                            return bin(c) != b;
                                          }),
                           candidates.end());
        }
    }



    /// Speed on the background grid that 99.9 % of the mass does not exceed,
    /// m/s; 0 before the first step. Nodes at the edge of the soil with hardly
    /// any mass, and a single point, may be arbitrarily fast. Collective.
    template <int dim>
    double
    maximum_speed(const State<dim> &state)
    {
      std::vector<Share> nodes;
      for (const unsigned int node : state.nodes.active_nodes())
        nodes.push_back(
          {state.nodes.velocity(node).norm(), state.nodes.mass(node)});
      const double speed = quantile(nodes, 0.999, state.communicator());
      return std::isnan(speed) ? 0. : speed;
    }
  } // namespace



  template <int dim>
  double
  front_of_mass(const Points<dim> &points,
                const unsigned int axis,
                const double       fraction,
                const MPI_Comm     communicator)
  {
    std::vector<Share> shares(points.size());
    for (unsigned int p = 0; p < points.size(); ++p)
      shares[p] = {points.data(points.position, axis)[p],
                   points.data(points.mass)[p]};
    return quantile(std::move(shares), fraction, communicator);
  }



  namespace
  {
    /// Append the largest excess pore pressure and pore pressure ratio.
    /// Collective.
    template <int dim>
    void
    list_pore_pressure(const State<dim> &state, Quantities &list)
    {
      const Points<dim> &points = state.points;
      double             u = std::numeric_limits<double>::lowest(), ratio = u;
      for (unsigned int p = 0; p < points.size(); ++p)
        u = std::max(u, points.data(points.pore_pressure())[p]);
      for (const double r_u : pore_pressure_ratio(points))
        ratio = std::max(ratio, r_u);
      list.push_back({"largest excess pore pressure",
                      "Pa",
                      Utilities::MPI::max(u, state.communicator())});
      list.push_back({"largest pore pressure ratio",
                      "-",
                      Utilities::MPI::max(ratio, state.communicator())});
    }
  } // namespace



  /// Columns of statistics.csv are explained in doc/output.md. The front by
  /// mass needs additional messages, so it is computed only on request.
  template <int dim>
  void
  list_motion(const State<dim>  &state,
              const Ground<dim> &ground,
              const bool         with_runout,
              Quantities        &list)
  {
    const PointSums<dim> sums =
      sum_over_points(state.points, state.communicator());
    list.push_back({"points", "", sums.n_points});
    for (unsigned int d = 0; with_runout && d < dim; d += 2)
      {
        const std::string axis(1, "xyz"[d]);
        list.push_back({"front " + axis, "m", sums.extent.upper[d]});
        list.push_back(
          {"front of 99.5 % mass " + axis,
           "m",
           front_of_mass(state.points, d, 0.995, state.communicator())});
        list.push_back({"rear " + axis, "m", sums.extent.lower[d]});
      }
    list.push_back({"height",
                    "m",
                    ground.is_bottom_face()
                      ? sums.extent.upper[1] - state.grid.domain().lower[1]
                      : Utilities::MPI::max(height_above(ground, state.points),
                                            state.communicator())});
    append_vector<dim>(list, "centre", "m", sums.moment / sums.mass);
    append_vector<dim>(list,
                       "centre velocity",
                       "m/s",
                       sums.momentum / sums.mass);
    list.push_back({"maximum speed", "m/s", maximum_speed(state)});
    list.push_back({"maximum speed of points", "m/s", sums.maximum_speed});
    if (state.points.have_pore_pressure())
      list_pore_pressure(state, list);
    list.push_back({"mass", "kg", sums.mass});
    append_vector<dim>(list, "momentum", "kg m/s", sums.momentum);
  }



  template decltype(front_of_mass<2>) front_of_mass<2>;
  template decltype(front_of_mass<3>) front_of_mass<3>;
  template decltype(list_motion<2>)   list_motion<2>;
  template decltype(list_motion<3>)   list_motion<3>;
} // namespace talus

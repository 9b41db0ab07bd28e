#include <talus/base/agreement.h>
#include <talus/observers/fracture.h>
#include <talus/observers/statistics.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Sums over the points, and what follows from them.
    template <int dim>
    struct PointSums
    {
      double         n_points = 0;
      double         mass     = 0; // kg
      Tensor<1, dim> moment;       // kg m
      Tensor<1, dim> momentum;     // kg m/s
      double         front         = std::numeric_limits<double>::lowest();
      double         rear          = std::numeric_limits<double>::max();
      double         top           = std::numeric_limits<double>::lowest();
      double         maximum_speed = 0; // m/s
    };



    template <int dim>
    PointSums<dim>
    sum_over_own_points(const Points<dim> &points)
    {
      PointSums<dim> result;
      result.n_points           = points.size();
      const double *mass        = points.data(points.mass);
      double        top_speed_2 = 0;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          double speed_2 = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double v = points.data(points.velocity, d)[p];
              result.moment[d] += mass[p] * points.data(points.position, d)[p];
              result.momentum[d] += mass[p] * v;
              speed_2 += v * v;
            }
          result.mass += mass[p];
          top_speed_2 = std::max(top_speed_2, speed_2);

          const double x = points.data(points.position, 0)[p];
          result.front   = std::max(result.front, x);
          result.rear    = std::min(result.rear, x);
          result.top = std::max(result.top, points.data(points.position, 1)[p]);
        }
      result.maximum_speed = std::sqrt(top_speed_2);
      return result;
    }



    template <int dim>
    PointSums<dim>
    sum_over_points(const Points<dim> &points, const MPI_Comm communicator)
    {
      PointSums<dim> sum = sum_over_own_points(points);
      sum.n_points       = Utilities::MPI::sum(sum.n_points, communicator);
      sum.mass           = Utilities::MPI::sum(sum.mass, communicator);
      sum.moment         = Utilities::MPI::sum(sum.moment, communicator);
      sum.momentum       = Utilities::MPI::sum(sum.momentum, communicator);
      sum.front          = Utilities::MPI::max(sum.front, communicator);
      sum.rear           = Utilities::MPI::min(sum.rear, communicator);
      sum.top            = Utilities::MPI::max(sum.top, communicator);
      sum.maximum_speed  = Utilities::MPI::max(sum.maximum_speed, communicator);
      return sum;
    }



    template <int dim>
    void
    append(std::vector<typename Statistics<dim>::Quantity> &row,
           const std::string                               &name,
           const std::string                               &unit,
           const Tensor<1, dim>                            &vector)
    {
      const std::string axes = "xyz";
      for (unsigned int d = 0; d < dim; ++d)
        row.push_back({name + ' ' + axes[d] + unit, vector[d]});
    }



    template <int dim>
    void
    append(std::vector<typename Statistics<dim>::Quantity> &row,
           const EnergyTerms                               &energy)
    {
      row.insert(row.end(),
                 {{"kinetic energy [J]", energy.kinetic},
                  {"grid kinetic energy [J]", energy.grid_kinetic},
                  {"elastic energy [J]", energy.elastic},
                  {"plastic work [J]", energy.plastic},
                  {"friction work [J]", energy.friction},
                  {"contact work [J]", energy.contact},
                  {"damping work [J]", energy.damping},
                  {"gravity work [J]", energy.gravity},
                  {"energy remainder [J]", energy.remainder}});
    }



    template <int dim>
    void
    append_fracture_and_splits(
      std::vector<typename Statistics<dim>::Quantity> &row,
      const Snapshot<dim>                             &snapshot)
    {
      const MPI_Comm         communicator = snapshot.grid.communicator();
      const SplitStatistics &splits       = snapshot.splits;
      const FractureCounts   fracture =
        count_fractures(snapshot.points, snapshot.grid);
      const auto add = [&row](const std::string &name, const double value) {
        row.push_back({name, value});
      };
      add("empty interior cells", fracture.empty_interior_cells);
      add("empty columns", fracture.empty_columns);
      add("connected bodies", fracture.connected_bodies);
      add("cells with one point", fracture.cells_with_one_point);
      add("splits", Utilities::MPI::sum(splits.n_splits, communicator));
      add("largest generation",
          Utilities::MPI::max(splits.largest_generation, communicator));
      add("clipped boxes",
          Utilities::MPI::sum(count_clipped_boxes(snapshot.points,
                                                  snapshot.grid,
                                                  snapshot.box_shape),
                              communicator));
      add("split ledger [-]", Utilities::MPI::max(splits.ledger, communicator));
    }
  } // namespace



  // Finds the place by counting mass in bins and going on with the points of
  // the one bin that holds it: no sort, and only the bins travel between ranks.
  template <int dim>
  double
  front_of_mass(const Points<dim> &points,
                const double       fraction,
                const MPI_Comm     communicator)
  {
    constexpr unsigned int n_bins = 1024;
    struct Candidate
    {
      double x, mass;
    };
    std::vector<Candidate> candidates(points.size());
    double                 mass = 0, mass_below = 0;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        candidates[p] = {points.data(points.position, 0)[p],
                         points.data(points.mass)[p]};
        mass += candidates[p].mass;
      }
    // Less than any point's mass, more than the round-off of the sum: with 200
    // equal points it is surely the 199th that completes 99.5 %.
    const double target =
      (fraction - 1e-12) * Utilities::MPI::sum(mass, communicator);

    while (true)
      {
        double lower = std::numeric_limits<double>::max();
        double upper = std::numeric_limits<double>::lowest();
        for (const Candidate &c : candidates)
          {
            lower = std::min(lower, c.x);
            upper = std::max(upper, c.x);
          }
        lower = Utilities::MPI::min(lower, communicator);
        upper = Utilities::MPI::max(upper, communicator);
        if (!(lower < upper))
          return upper;

        const auto bin = [&](const Candidate &c) {
          const double at = (c.x - lower) / (upper - lower) * n_bins;
          return std::min(n_bins - 1, static_cast<unsigned int>(at));
        };
        std::vector<double> bins(n_bins, 0.);
        for (const Candidate &c : candidates)
          bins[bin(c)] += c.mass;
        Utilities::MPI::sum(bins, communicator, bins);

        unsigned int b = 0;
        for (; b + 1 < n_bins && mass_below + bins[b] < target; ++b)
          mass_below += bins[b];
        candidates.erase(std::remove_if(candidates.begin(),
                                        candidates.end(),
                                        [&](const Candidate &c) {
                                          return bin(c) != b;
                                        }),
                         candidates.end());
      }
  }



  template <int dim>
  std::vector<typename Statistics<dim>::Quantity>
  Statistics<dim>::evaluate(const Snapshot<dim> &snapshot) const
  {
    const MPI_Comm       communicator = snapshot.grid.communicator();
    const PointSums<dim> motion =
      sum_over_points(snapshot.points, communicator);
    const double impulse =
      Utilities::MPI::sum(snapshot.boundary_work.seabed_impulse[0],
                          communicator);
    const double interval = snapshot.time - previous_time_;

    std::vector<Quantity> row = {{"time [s]", snapshot.time},
                                 {"step", static_cast<double>(snapshot.step)},
                                 {"time step [s]", snapshot.time_step},
                                 {"points", motion.n_points}};
    if (has_runout_)
      row.insert(row.end(),
                 {{"front x [m]", motion.front},
                  {"front of 99.5 % mass x [m]",
                   front_of_mass(snapshot.points, 0.995, communicator)},
                  {"rear x [m]", motion.rear}});
    row.push_back({"height [m]", motion.top - snapshot.grid.domain().lower[1]});
    append<dim>(row, "centre", " [m]", motion.moment / motion.mass);
    append<dim>(row,
                "centre velocity",
                " [m/s]",
                motion.momentum / motion.mass);
    row.insert(row.end(),
               {{"maximum speed [m/s]", motion.maximum_speed},
                {"mass [kg]", motion.mass},
                {"momentum x [kg m/s]", motion.momentum[0]},
                {"seabed force x [N]",
                 interval > 0 ? (impulse - previous_impulse_) / interval : 0.},
                {"seabed impulse x [N s]", impulse}});
    append<dim>(row, budget_.evaluate(snapshot));
    append_fracture_and_splits<dim>(row, snapshot);
    return row;
  }



  template <int dim>
  void
  Statistics<dim>::begin(const std::filesystem::path &folder,
                         const Snapshot<dim>         &snapshot,
                         const Beginning              beginning)
  {
    const std::vector<std::string> columns = names(snapshot);
    if (Utilities::MPI::this_mpi_process(snapshot.grid.communicator()) == 0)
      file_.open(folder / file_name, columns, beginning);
  }



  template <int dim>
  void
  Statistics<dim>::add_first_row(const Snapshot<dim> &snapshot)
  {
    budget_.begin(snapshot);
    previous_time_ = snapshot.time;
    previous_impulse_ =
      Utilities::MPI::sum(snapshot.boundary_work.seabed_impulse[0],
                          snapshot.grid.communicator());
    add_row(snapshot);
  }



  template <int dim>
  std::vector<std::string>
  Statistics<dim>::names(const Snapshot<dim> &snapshot) const
  {
    std::vector<std::string> result;
    for (const Quantity &quantity : evaluate(snapshot))
      result.push_back(quantity.name);
    return result;
  }



  template <int dim>
  void
  Statistics<dim>::list_state(StateList &list)
  {
    list.add("time of the last row", "s", previous_time_, Reduction::equal);
    list.add("seabed impulse at the last row",
             "N s",
             previous_impulse_,
             Reduction::equal);
    file_.list_state(file_name, list);
    budget_.list_state(list);
  }



  template <int dim>
  void
  Statistics<dim>::add_row(const Snapshot<dim> &snapshot)
  {
    const MPI_Comm      communicator = snapshot.grid.communicator();
    std::vector<double> values;
    for (const Quantity &quantity : evaluate(snapshot))
      values.push_back(quantity.value);
    if (is_first_rank(communicator))
      {
        file_.add_row(values);
        file_.flush();
      }
    previous_time_ = snapshot.time;
    previous_impulse_ =
      Utilities::MPI::sum(snapshot.boundary_work.seabed_impulse[0],
                          communicator);
  }



  template double
  front_of_mass(const Points<2> &, double, MPI_Comm);
  template double
  front_of_mass(const Points<3> &, double, MPI_Comm);
  template class Statistics<2>;
  template class Statistics<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/shear_bands.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <set>

namespace talus
{
  using namespace dealii;

  namespace
  {
    constexpr double nearly_residual = 0.95; // fraction of the strength loss

    /// Place of a column of cells of size h, in x and z.
    using Place = std::array<long, 2>;

    /// Columns of cells with soil of a body.
    struct Columns
    {
      std::set<Place> all, yielded, residual;
    };



    /// Columns of a body with soil of this rank. A larger cell holds at least
    /// one point, so columns of the largest size have no gaps.
    template <int dim>
    Columns
    columns_of(const State<dim>         &state,
               const MaterialModel<dim> &material,
               const unsigned int        body)
    {
      const Points<dim> &points = state.points;
      const double       h      = state.grid.cell_size();
      Columns            columns;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          if (points.data(points.body)[p] != body)
            continue;
          const auto  x     = load_place(points, points.position, p);
          const Place place = {
            {static_cast<long>(std::floor(x[0] / h)),
             dim == 3 ? static_cast<long>(std::floor(x[dim - 1] / h)) : 0}};
          columns.all.insert(place);
          if (points.data(points.plastic_work)[p] > 0.)
            columns.yielded.insert(place);
          if (material.fraction_of_strength_loss(points, p) >= nearly_residual)
            columns.residual.insert(place);
        }
      return columns;
    }



    /// Number of places of all ranks together. Collective.
    unsigned int
    count(const std::set<Place> &places, const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        return places.size();
      std::set<Place> together;
      for (const auto &part : Utilities::MPI::all_gather(
             communicator, std::vector<Place>(places.begin(), places.end())))
        together.insert(part.begin(), part.end());
      return together.size();
    }
  } // namespace



  template <int dim>
  YieldedExtent
  yielded_extent(const State<dim>   &state,
                 const Problem<dim> &problem,
                 const unsigned int  body)
  {
    const MPI_Comm communicator = state.communicator();
    const Columns  columns =
      columns_of(state, problem.materials.of_body(body), body);
    const double unit = std::pow(state.grid.cell_size(), dim - 1);
    return {unit * count(columns.all, communicator),
            unit * count(columns.yielded, communicator),
            unit * count(columns.residual, communicator)};
  }



  namespace
  {
    /// How much of each softening body has yielded, in words; empty if nothing
    /// has. Collective.
    template <int dim>
    std::string
    yielded_bodies(const State<dim> &state, const Problem<dim> &problem)
    {
      const auto  names = problem.bodies().names();
      std::string list;
      for (unsigned int b = 0; b < names.size(); ++b)
        {
          if (!problem.materials.of_body(b).softens())
            continue;
          const YieldedExtent extent = yielded_extent(state, problem, b);
          if (extent.yielded > 0.)
            list += text(list.empty() ? "" : "; ",
                         std::setprecision(4),
                         extent.yielded,
                         " of ",
                         extent.all,
                         dim == 2 ? " m of '" : " m^2 (in plan) of '",
                         names[b],
                         "'");
        }
      return list.empty() ? list : list + " yielded";
    }



    /// How much of the softening surfaces soil has slipped over, in words;
    /// empty if nothing has. Collective.
    template <int dim>
    std::string
    slipped_surfaces(const State<dim> &state, const Problem<dim> &problem)
    {
      const Obstacles<dim>    &obstacles = problem.obstacles;
      std::vector<std::string> names{"the seabed"};
      for (unsigned int k = 0; k < obstacles.size(); ++k)
        names.push_back("the obstacle '" + obstacles[k].name() + "'");
      const std::vector<double> areas =
        problem.contact.slip().slipped_areas(names.size(),
                                             state.communicator());
      std::string list;
      for (unsigned int i = 0; i < areas.size(); ++i)
        if (areas[i] > 0.)
          list += text(list.empty() ? "" : "; ",
                       std::setprecision(4),
                       areas[i],
                       dim == 2 ? " m of " : " m^2 of ",
                       names[i]);
      return list.empty() ? list : list + " slipped";
    }
  } // namespace



  template <int dim>
  std::string
  note_on_softening(const State<dim> &state, const Problem<dim> &problem)
  {
    std::string       list    = yielded_bodies(state, problem);
    const std::string slipped = slipped_surfaces(state, problem);
    if (!list.empty() && !slipped.empty())
      list += "; ";
    list += slipped;
    if (list.empty())
      return {};
    return " Softening: " + list + ", a likely cause.";
  }



  template decltype(yielded_extent<2>)    yielded_extent<2>;
  template decltype(yielded_extent<3>)    yielded_extent<3>;
  template decltype(note_on_softening<2>) note_on_softening<2>;
  template decltype(note_on_softening<3>) note_on_softening<3>;



  namespace
  {
    /// Sum of the plastic work of a body, J. Collective.
    template <int dim>
    double
    plastic_work(const State<dim> &state, const unsigned int body)
    {
      const Points<dim> &points = state.points;
      double             sum    = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points.data(points.body)[p] == body)
          sum += points.data(points.plastic_work)[p];
      return Utilities::MPI::sum(sum, state.communicator());
    }
  } // namespace



  template <int dim>
  bool
  ShearBands<dim>::is_enabled(const OutputSettings & /*settings*/) const
  {
    return !softening_bodies().empty();
  }



  template <int dim>
  std::vector<unsigned int>
  ShearBands<dim>::softening_bodies() const
  {
    std::vector<unsigned int> bodies;
    for (unsigned int b = 0; b < length_.size(); ++b)
      if (problem_.materials.of_body(b).softens())
        bodies.push_back(b);
    return bodies;
  }



  template <int dim>
  std::vector<std::string>
  ShearBands<dim>::columns(const OutputSettings & /*settings*/,
                           const State<dim> & /*state*/) const
  {
    const std::string name = dim == 2 ? "length" : "area";
    const std::string unit = dim == 2 ? "m" : "m^2";
    const auto        body = problem_.bodies().names();

    std::vector<std::string> result = {"time [s]"};
    for (const unsigned int b : softening_bodies())
      {
        result.push_back("yielded " + name + " of " + body[b] + " [" + unit +
                         "]");
        result.push_back("residual " + name + " of " + body[b] + " [" + unit +
                         "]");
        result.push_back("growth of the yielded " + name + " of " + body[b] +
                         " [" + unit + "/s]");
        result.push_back("plastic work of " + body[b] + " [J]");
      }
    return result;
  }



  // The first row has no row before, so no growth.
  template <int dim>
  void
  ShearBands<dim>::observe(const State<dim> &state)
  {
    const double        elapsed = state.time - time_;
    std::vector<double> row     = {state.time};
    for (const unsigned int b : softening_bodies())
      {
        const YieldedExtent extent = yielded_extent(state, problem_, b);
        const double        growth = extent.yielded - length_[b];
        row.insert(row.end(),
                   {extent.yielded,
                    extent.residual,
                    elapsed > 0. ? growth / elapsed : 0.,
                    plastic_work(state, b)});
        length_[b] = extent.yielded;
      }
    time_ = state.time;
    this->add_rows(state, {row});
  }



  // Checkpoints of runs without softening soil have nothing of this table.
  template <int dim>
  void
  ShearBands<dim>::list_state(StateList &list)
  {
    if (softening_bodies().empty())
      return;
    TableObserver<dim>::list_state(list);
    list.add("time of the last row of bands", "s", time_, Reduction::equal);
    list.add_components("yielded extent of body",
                        dim == 2 ? "m" : "m^2",
                        length_,
                        length_.size(),
                        Reduction::equal);
  }



  template class ShearBands<2>;
  template class ShearBands<3>;
} // namespace talus

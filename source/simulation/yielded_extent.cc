// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/yielded_extent.h>

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
} // namespace talus

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
    /// Place of a column of cells of size h, in x and z.
    using Place = std::array<long, 2>;

    /// Columns of cells with soil of a body.
    struct Columns
    {
      std::set<Place> all, yielded;
    };



    /// Columns of a body with soil of this rank. A larger cell holds at least
    /// one point, so columns of the largest size have no gaps.
    template <int dim>
    Columns
    columns_of(const State<dim> &state, const unsigned int body)
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
        }
      return columns;
    }



    /// Number of places of all ranks together. Collective.
    unsigned int
    count(const std::set<Place> &places, const MPI_Comm communicator)
    {
      std::set<Place> together;
      for (const auto &part : Utilities::MPI::all_gather(
             communicator, std::vector<Place>(places.begin(), places.end())))
        together.insert(part.begin(), part.end());
      return together.size();
    }
  } // namespace



  // A law softens if a larger strength would have to be refused.
  template <int dim>
  std::string
  note_on_softening(const State<dim> &state, const Problem<dim> &problem)
  {
    const MPI_Comm communicator = state.communicator();
    const auto    &materials    = problem.materials;
    const auto     names        = problem.bodies().names();
    const double   h            = state.grid.cell_size();
    const double   unit         = dim == 2 ? h : h * h;
    std::string    list;
    for (unsigned int b = 0; b < names.size(); ++b)
      {
        const auto range =
          materials.strength_range(state.points, b, communicator);
        if (std::isinf(materials.of_body(b).largest_strength_factor(range)))
          continue;
        const Columns columns   = columns_of(state, b);
        const double  n_yielded = count(columns.yielded, communicator);
        const double  n_all     = count(columns.all, communicator);
        if (n_yielded > 0.)
          list += text(list.empty() ? "" : "; ",
                       std::setprecision(4),
                       n_yielded * unit,
                       " of ",
                       n_all * unit,
                       dim == 2 ? " m of '" : " m^2 (in plan) of '",
                       names[b],
                       "'");
      }
    if (list.empty())
      return {};
    return " Softening: " + list + " yielded.";
  }



  template decltype(note_on_softening<2>) note_on_softening<2>;
  template decltype(note_on_softening<3>) note_on_softening<3>;
} // namespace talus

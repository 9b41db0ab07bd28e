// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/body_thickness.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // In thinner layers, top and base move with the same nodes.
    constexpr double n_cells_to_shear = 2.;

    /// Column of cells above the plan: body, number along x, number along z.
    using BodyColumn = std::array<long, 3>;



    /// Return the thickness of the points on this rank in each column, in
    /// cells. Columns are as wide as the smallest cells, and points of a cell
    /// lie in one column.
    template <int dim>
    std::map<BodyColumn, double>
    columns_of_rank(const Points<dim>         &points,
                    const std::vector<double> &cell_size)
    {
      std::map<BodyColumn, double> columns;
      for (unsigned int p = 0; p < points.size(); ++p)
        {
          const unsigned int b = points.data(points.body)[p];
          const double       h = cell_size[b];
          const auto         x = load_place(points, points.initial_position, p);
          const BodyColumn   column{
            {b,
               std::lround(std::floor(x[0] / h)),
             dim == 3 ? std::lround(std::floor(x[dim - 1] / h)) : 0}};
          columns[column] +=
            points.data(points.reference_volume)[p] / std::pow(h, dim);
        }
      return columns;
    }



    /// Sum columns shared between ranks; the numbers of a column determine the
    /// receiving rank. Collective.
    std::map<BodyColumn, double>
    whole_columns(const std::map<BodyColumn, double> &parts,
                  const MPI_Comm                      communicator)
    {
      const unsigned int n_ranks =
        Utilities::MPI::n_mpi_processes(communicator);
      std::map<unsigned int, std::vector<std::pair<BodyColumn, double>>>
        messages;
      for (const auto &part : parts)
        messages[std::abs(part.first[1] + 7 * part.first[2]) % n_ranks]
          .push_back(part);
      std::map<BodyColumn, double> result;
      for (const auto &[rank, message] :
           Utilities::MPI::some_to_some(communicator, messages))
        for (const auto &[column, thickness] : message)
          result[column] += thickness;
      return result;
    }
  } // namespace



  template <int dim>
  std::vector<BodyThickness>
  measure_thickness(const Points<dim>                             &points,
                    const std::vector<std::unique_ptr<Body<dim>>> &bodies,
                    const Grid<dim>                               &grid)
  {
    std::vector<double> cell_size, n_cells(bodies.size(), 0.);
    for (const auto &body : bodies)
      cell_size.push_back(
        grid.finest_size_in(body->bounding_box(grid.domain_before_growth())));
    for (const auto &[column, thickness] :
         whole_columns(columns_of_rank(points, cell_size), grid.communicator()))
      n_cells[column[0]] = std::max(n_cells[column[0]], thickness);
    std::vector<BodyThickness> result;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      result.push_back({bodies[b]->name(),
                        cell_size[b],
                        Utilities::MPI::max(n_cells[b], grid.communicator())});
    return result;
  }



  std::string
  sentence_on_thinnest(const std::vector<BodyThickness> &bodies)
  {
    const auto thinnest = std::min_element(bodies.begin(),
                                           bodies.end(),
                                           [](const auto &a, const auto &b) {
                                             return a.n_cells < b.n_cells;
                                           });
    if (thinnest == bodies.end())
      return "";
    return text(std::setprecision(3),
                "The thinnest body, '",
                thinnest->body,
                "', is ",
                thinnest->n_cells,
                " cells of ",
                thinnest->cell_size,
                " m thick where it is thickest.");
  }



  std::vector<std::string>
  notes_on_thickness(const std::vector<BodyThickness> &bodies)
  {
    std::vector<std::string> notes;
    for (const BodyThickness &body : bodies)
      if (body.n_cells < (1. - 1e-6) * n_cells_to_shear)
        notes.push_back(
          text(std::setprecision(3),
               "The body '",
               body.body,
               "' is ",
               body.n_cells,
               " cells of ",
               body.cell_size,
               " m thick where it is thickest, less than two: top and "
               "base move with the same nodes, and the body hardly "
               "shears. Cells of ",
               body.n_cells / n_cells_to_shear * body.cell_size,
               " m or less there, by 'Grid/Cell size' or 'Grid/Refinement "
               "boxes', resolve it."));
    return notes;
  }



  template decltype(measure_thickness<2>) measure_thickness<2>;
  template decltype(measure_thickness<3>) measure_thickness<3>;
} // namespace talus

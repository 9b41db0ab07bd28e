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

    /// Column of cells above the plan: number of the body, or of all bodies
    /// with cells of a size behind the number of bodies; number along x; number
    /// along z.
    using BodyColumn = std::array<long, 3>;



    /// Return the number of the first body with the same cells.
    unsigned int
    number_of_size(const std::vector<double> &cell_size, const unsigned int b)
    {
      return std::find(cell_size.begin(), cell_size.end(), cell_size[b]) -
             cell_size.begin();
    }



    /// Return the thickness of the points on this rank in each column, in
    /// cells: of each body, and of all bodies for each cell size. Columns are
    /// as wide as the smallest cells of a body, and points of a cell lie in one
    /// column.
    template <int dim>
    std::map<BodyColumn, double>
    columns_of_rank(const Points<dim>         &points,
                    const std::vector<double> &cell_size)
    {
      std::map<BodyColumn, double> columns;
      const unsigned int           n_bodies = cell_size.size();
      for (unsigned int p = 0; p < points.size(); ++p)
        for (unsigned int b = 0; b < n_bodies; ++b)
          {
            const double h = cell_size[b];
            const auto   x = load_place(points, points.initial_position, p);
            BodyColumn   column{
              {n_bodies + b,
                 std::lround(std::floor(x[0] / h)),
               dim == 3 ? std::lround(std::floor(x[dim - 1] / h)) : 0}};
            const double thickness =
              points.data(points.reference_volume)[p] / std::pow(h, dim);
            if (number_of_size(cell_size, b) == b)
              columns[column] += thickness;
            column[0] = b;
            if (points.data(points.body)[p] == b)
              columns[column] += thickness;
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
    const auto columns =
      whole_columns(columns_of_rank(points, cell_size), grid.communicator());
    for (const auto &[column, thickness] : columns)
      if (const unsigned int b = column[0]; b < bodies.size())
        {
          BodyColumn all = column;
          all[0]         = bodies.size() + number_of_size(cell_size, b);
          n_cells[b]     = std::max(n_cells[b], columns.at(all));
        }
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
                "', lies in soil ",
                counted(thinnest->n_cells, "cell"),
                " of ",
                thinnest->cell_size,
                " m thick where it is thickest.");
  }



  std::vector<Remark>
  notes_on_thickness(const std::vector<BodyThickness> &bodies,
                     const bool                        slides)
  {
    std::vector<Remark> notes;
    for (const BodyThickness &body : bodies)
      if (body.n_cells < (1. - 1e-6) * n_cells_to_shear)
        notes.emplace_back(
          text(std::setprecision(3),
               "the soil is ",
               counted(body.n_cells, "cell"),
               " of ",
               body.cell_size,
               " m thick where it is thickest, less than two: top and "
               "base move with the same nodes, and the soil hardly "
               "shears. Cells of ",
               body.n_cells / n_cells_to_shear * body.cell_size,
               " m or less there, by 'Grid/Cell size' or 'Grid/Refinement "
               "boxes', resolve it."),
          slides && body.n_cells >= 1. ? Severity::information : Severity::look,
          "body '" + body.body + "'");
    return notes;
  }



  template decltype(measure_thickness<2>) measure_thickness<2>;
  template decltype(measure_thickness<3>) measure_thickness<3>;
} // namespace talus

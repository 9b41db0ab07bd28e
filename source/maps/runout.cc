// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/agreement.h>
#include <talus/base/errors.h>
#include <talus/maps/runout.h>
#include <talus/observers/boxes.h>
#include <talus/terrain/plan_place.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Distance between corners of the path of the centre of mass, in cells.
    constexpr double distance_of_corners = 4.;

    /// Fraction of the initial mass below which the path is not extended.
    constexpr double min_mass_fraction = 0.99;
  } // namespace



  RunoutSettings::RunoutSettings()
    : ParameterAcceptor("/Runout")
  {
    add_parameter(
      "Path",
      path_,
      "3-D only: corners of the line in plan along which front, rear and "
      "runout in runout.csv are measured, 'x, z; x, z; ...' [m], such as a "
      "thalweg. Empty: the path of the centre of mass so far.");
    add_parameter("Coordinates",
                  coordinates_,
                  "Coordinates of 'Path'; 'map': easting and northing in place "
                  "of x and z.",
                  this->prm,
                  Patterns::Selection("mesh|map"));
    add_parameter("Smallest thickness",
                  smallest_thickness_,
                  "Thickness of soil below which a column counts neither for "
                  "front, rear and area, nor for the largest speed [m]. 0: a "
                  "tenth of 'Grid/Cell size'.",
                  this->prm,
                  Patterns::Double(0.));
  }



  std::vector<Point<2>>
  RunoutSettings::corners(const unsigned int dim, const Point<3> &origin) const
  {
    AssertThrow(dim == 3 || (path_.empty() && coordinates_ == "mesh"),
                ExcUser("'Runout/Path' or 'Runout/Coordinates' is given, but "
                        "the simulation is two-dimensional, where the path is "
                        "always along x. Remove the entry."));
    std::vector<Point<2>> result;
    for (const std::string &place : Utilities::split_string_list(path_, ';'))
      {
        const Point<3> x = parse_plan_place<3>(
          "Runout/Path",
          place,
          PlaceCoordinates("Runout", coordinates_, dim, origin).kind(),
          origin);
        const Point<2> corner(x[0], x[2]);
        AssertThrow(result.empty() || corner.distance(result.back()) > 0.,
                    ExcUser("'Runout/Path' has the corner '" + place +
                            "' twice in succession. Remove one of them."));
        result.push_back(corner);
      }
    AssertThrow(result.size() != 1,
                ExcUser("'Runout/Path' has one corner only, '" + path_ +
                        "', where two or more were expected, separated by "
                        "semicolons."));
    return result;
  }



  template <int dim>
  void
  Runout<dim>::begin(const OutputSettings &settings,
                     const State<dim>     &state,
                     const Beginning       beginning)
  {
    user_path_ = settings_.corners(dim, origin_);
    TableObserver<dim>::begin(settings, state, beginning);
  }



  /// Sum the soil over columns as wide as a cell; the sums are on the first
  /// rank. The statistics may ask for them before begin().
  template <int dim>
  void
  Runout<dim>::sum_columns(const State<dim> &state)
  {
    if (!sums_)
      make_sums(state);
    sums_->sum_soil(state);
    sums_->sum_over_ranks(state.communicator());
  }



  template <int dim>
  void
  Runout<dim>::make_sums(const State<dim> &state)
  {
    const Box<dim> domain = state.grid.domain_before_growth();
    const double   h      = state.grid.cell_size();
    std::array<typename LatticeColumns<dim>::Axis, dim - 1> axes;
    for (unsigned int a = 0; a < dim - 1; ++a)
      {
        const unsigned int d = axis_of_plan<dim>(a);
        // Round-off must not add a column.
        axes[a] = {domain.lower[d],
                   h,
                   static_cast<unsigned int>(
                     std::max(1., std::ceil(domain.length(d) / h - 1e-9)))};
      }
    sums_ = std::make_unique<ColumnSums<dim>>(
      std::make_shared<LatticeColumns<dim>>(axes));
  }



  /// Return the outer edges, along x (and z), of the columns with thick soil,
  /// m; the box is empty without. Collective.
  template <int dim>
  Box<dim>
  Runout<dim>::thick_columns(const State<dim> &state) const
  {
    const double h     = state.grid.cell_size();
    const double least = settings_.smallest_thickness(h);
    Box<dim>     box;
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.lower[d] = std::numeric_limits<double>::max();
        box.upper[d] = std::numeric_limits<double>::lowest();
      }
    if (is_first_rank(state.communicator()))
      for (const unsigned int column : sums_->with_soil())
        if (sums_->thickness(column) >= least)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double x = sums_->columns().centre(column)[d];
              box.lower[d]   = std::min(box.lower[d], x - 0.5 * h);
              box.upper[d]   = std::max(box.upper[d], x + 0.5 * h);
            }
    return Utilities::MPI::broadcast(state.communicator(), box);
  }



  // The boxes are finer than the columns, which only tell thick soil from thin.
  template <int dim>
  void
  Runout<dim>::list_thick_soil(const State<dim> &state, Quantities &list)
  {
    sum_columns(state);
    const Box<dim>     columns = thick_columns(state);
    Box<dim>           ends{columns.upper, columns.lower};
    const Points<dim> &points = state.points;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const auto lengths = box_lengths(state, p);
        for (unsigned int d = 0; d < dim; d += 2)
          {
            const double x     = points.data(points.position, d)[p],
                         lower = x - 0.5 * lengths[d],
                         upper = x + 0.5 * lengths[d];
            if (lower < columns.upper[d] && upper > columns.lower[d])
              {
                ends.upper[d] =
                  std::max(ends.upper[d], std::min(upper, columns.upper[d]));
                ends.lower[d] =
                  std::min(ends.lower[d], std::max(lower, columns.lower[d]));
              }
          }
      }
    for (unsigned int d = 0; d < dim; d += 2)
      {
        const bool   exists = columns.lower[d] < columns.upper[d];
        const double front =
          Utilities::MPI::max(ends.upper[d], state.communicator());
        const double rear =
          Utilities::MPI::min(ends.lower[d], state.communicator());
        const double      none = std::numeric_limits<double>::quiet_NaN();
        const std::string axis(1, "xyz"[d]);
        list.push_back(
          {"front of thick soil " + axis, "m", exists ? front : none});
        list.push_back(
          {"rear of thick soil " + axis, "m", exists ? rear : none});
      }
  }



  template <int dim>
  std::vector<std::string>
  Runout<dim>::columns(const OutputSettings & /*settings*/,
                       const State<dim> & /*state*/) const
  {
    return {"time [s]",
            "runout [m]",
            "front along path [m]",
            "rear along path [m]",
            "centre along path [m]",
            "speed of the centre [m/s]",
            "largest depth-mean speed [m/s]",
            dim == 2 ? "length in plan [m]" : "area in plan [m^2]"};
  }



  /// Return position, m, and speed, m/s, of the centre of mass in plan.
  /// Collective.
  template <int dim>
  typename Runout<dim>::Centre
  Runout<dim>::centre_of_mass(const State<dim> &state) const
  {
    const Points<dim>  &points = state.points;
    std::vector<double> sums(5, 0.); // mass, mass * place, mass * velocity
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        const double mass     = points.data(points.mass)[p];
        const auto   place    = in_plan(load_place(points, points.position, p));
        const auto   velocity = in_plan(load_place(points, points.velocity, p));
        sums[0] += mass;
        for (unsigned int a = 0; a < 2; ++a)
          {
            sums[1 + a] += mass * place[a];
            sums[3 + a] += mass * velocity[a];
          }
      }
    Utilities::MPI::sum(sums, state.communicator(), sums);
    Centre centre;
    centre.mass  = sums[0];
    centre.place = Point<2>(sums[1], sums[2]) / sums[0];
    centre.speed = std::hypot(sums[3], sums[4]) / sums[0];
    return centre;
  }



  template <int dim>
  void
  Runout<dim>::start(const State<dim> &state)
  {
    const Centre centre = centre_of_mass(state);
    way_                = {centre.place};
    mass_at_start_      = centre.mass;
    sum_columns(state);
    release_.clear();
    const double least = settings_.smallest_thickness(state.grid.cell_size());
    if (is_first_rank(state.communicator()))
      for (const unsigned int column : sums_->with_soil())
        if (sums_->thickness(column) >= least)
          release_.push_back(column);
  }



  // Once soil leaves the mesh, the centre of mass of the remaining soil moves
  // back up the slope, and a path along it would fold.
  template <int dim>
  bool
  Runout<dim>::has_way_ended(const Centre &centre) const
  {
    return way_.size() > 1 && centre.mass < min_mass_fraction * mass_at_start_;
  }



  template <int dim>
  void
  Runout<dim>::extend_way(const Centre &centre, const double h)
  {
    if (!has_way_ended(centre) &&
        centre.place.distance(way_.back()) >= distance_of_corners * h)
      way_.push_back(centre.place);
  }



  /// A corner close to the centre is dropped: the centre of a slide at rest may
  /// stay close for long, and the segment in between would have an arbitrary
  /// direction.
  template <int dim>
  std::vector<Point<2>>
  Runout<dim>::way_until(const Centre &centre, const double h) const
  {
    std::vector<Point<2>> way = way_;
    if (has_way_ended(centre))
      return way;
    while (way.size() > 1 &&
           centre.place.distance(way.back()) < 0.5 * distance_of_corners * h)
      way.pop_back();
    if (centre.place.distance(way.back()) > 0.)
      way.push_back(centre.place);
    return way;
  }



  /// Row of the table, on the first rank; positions are zero while the path has
  /// no length.
  template <int dim>
  std::vector<double>
  Runout<dim>::row(const State<dim> &state, const Centre &centre) const
  {
    const double h     = state.grid.cell_size();
    const double least = settings_.smallest_thickness(h);
    const auto   way   = user_path_.empty() ? way_until(centre, h) : user_path_;
    std::vector<double> result = {
      state.time, 0., 0., 0., 0., centre.speed, 0., 0.};
    if (way.size() < 2)
      return result;
    const PlanPath path(way);
    const auto     chainage = [&](const unsigned int column) {
      return path.chainage(in_plan(sums_->columns().centre(column)));
    };
    double front = std::numeric_limits<double>::quiet_NaN(), rear = front,
           front_at_start = front;
    for (const unsigned int column : release_)
      front_at_start = std::fmax(front_at_start, chainage(column));
    for (const unsigned int column : sums_->with_soil())
      if (sums_->thickness(column) >= least)
        {
          front = std::fmax(front, chainage(column));
          rear  = std::fmin(rear, chainage(column));
          result[6] =
            std::max(result[6],
                     in_plan(Point<dim>(sums_->velocity(column))).norm());
          result[7] += sums_->columns().area();
        }
    // Extend front and rear to the outer edges of the outermost columns.
    result[1] = front - front_at_start;
    result[2] = front + 0.5 * h;
    result[3] = rear - 0.5 * h;
    result[4] = path.chainage(centre.place);
    return result;
  }



  template <int dim>
  void
  Runout<dim>::observe(const State<dim> &state)
  {
    const Centre centre = centre_of_mass(state);
    sum_columns(state);
    if (is_first_rank(state.communicator()))
      this->add_rows(state, {row(state, centre)});
    extend_way(centre, state.grid.cell_size());
  }



  /// All ranks have the same path.
  template <int dim>
  void
  Runout<dim>::list_state(StateList &list)
  {
    TableObserver<dim>::list_state(list);
    list.add("mass at the start", "kg", mass_at_start_, Reduction::equal);
    list.add_table({"way of the centre of mass",
                    "x [m], z [m]",
                    2,
                    [this]() {
                      std::vector<double> rows;
                      for (const Point<2> &corner : way_)
                        rows.insert(rows.end(), {corner[0], corner[1]});
                      return rows;
                    },
                    [this](const std::vector<double> &rows) {
                      way_.clear();
                      for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
                        way_.emplace_back(rows[i], rows[i + 1]);
                    },
                    /*is_common=*/true});
    list.add_table({"columns with soil at the start",
                    "column",
                    1,
                    [this]() {
                      return std::vector<double>(release_.begin(),
                                                 release_.end());
                    },
                    [this](const std::vector<double> &rows) {
                      release_.assign(rows.begin(), rows.end());
                    }});
  }



  template class Runout<2>;
  template class Runout<3>;
} // namespace talus

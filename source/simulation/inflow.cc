// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/inflow.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Mass at which a feeding point is divided, over the mass of a point of
    /// the filling [-]. A feeding point has 0.5 to 1.5 times this mass, and
    /// is never much lighter than the neighbours.
    constexpr double max_mass = 1.5;
  } // namespace



  template <int dim>
  Inflow<dim>::Inflow(State<dim>    &state,
                      Problem<dim>  &problem,
                      Splitter<dim> &splitter)
    : state_(state)
    , problem_(problem)
    , splitter_(splitter)
  {}



  template <int dim>
  void
  Inflow<dim>::prepare()
  {
    faces_.assign(problem_.bodies().size(), numbers::invalid_unsigned_int);
    bool is_open = false;
    for (unsigned int b = 0; b < faces_.size(); ++b)
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (const Body<dim> &body = *problem_.bodies().list()[b];
            body.inflow_face() == face_names[face])
          {
            const std::string entry = "'Bodies/" + body.name() +
                                      "/Inflow face' is '" + face_names[face] +
                                      "', but ";
            AssertThrow(problem_.boundaries.drives_normal(face),
                        ExcUser(entry +
                                "the face does not prescribe its normal "
                                "velocity. Set 'Boundaries/" +
                                face_names[face] + " = velocity' and '" +
                                face_names[face] + " velocity'."));
            AssertThrow(!problem_.materials.of_body(b).is_hyperelastic(),
                        ExcUser(entry +
                                "the law of the body is hyperelastic: new "
                                "soil would have no reference shape. Choose "
                                "another law."));
            faces_[b] = face;
            is_open   = true;
          }
    if (!is_open)
      return faces_.clear();
    state_.points.inflow_density = state_.points.add_column(
      "inflow mass per length", "kg/m", 1, Inheritance::copied);
    state_.accounts.open_energy("inflow energy",
                                Accounts<dim>::EnergyKind::supplied);
    state_.accounts.open_impulse("inflow momentum");
  }



  /// Face of the inflow of the body of point @p p.
  template <int dim>
  unsigned int
  Inflow<dim>::face_of(const unsigned int p) const
  {
    return faces_[state_.points.data(state_.points.body)[p]];
  }



  template <int dim>
  double
  Inflow<dim>::distance_to_face(const unsigned int p) const
  {
    const unsigned int face   = face_of(p);
    const Box<dim>    &domain = state_.grid.domain();
    const double x = state_.points.data(state_.points.position, face / 2)[p];
    return face % 2 == 0 ? x - domain.lower[face / 2]
                         : domain.upper[face / 2] - x;
  }



  /// The centre of a point in the first row is half a length from the face.
  /// Boxes of points at the rim of the opening may be shorter than the row.
  template <int dim>
  bool
  Inflow<dim>::touches_face(const unsigned int p) const
  {
    const unsigned int face = face_of(p);
    return face != numbers::invalid_unsigned_int &&
           distance_to_face(p) <
             0.99 * state_.points.data(state_.points.box_length, face / 2)[p];
  }



  /// Along the normal the point gets the length of the row, in the plane of the
  /// face the area that keeps the volume.
  template <int dim>
  void
  Inflow<dim>::start_feeding(const unsigned int p)
  {
    Points<dim>       &points = state_.points;
    const unsigned int d      = face_of(p) / 2;
    const double       length = 2. * distance_to_face(p);
    const Cell<dim>   &cell =
      state_.grid
        .cells()[state_.grid.find_cell(load_place(points, points.position, p))];
    AssertThrow(max_mass * length <= cell.size,
                ExcUser(
                  text("A point at the inflow of the body '",
                       problem_.bodies().names()[points.data(points.body)[p]],
                       "' is ",
                       length,
                       " m long in a cell of ",
                       cell.size,
                       " m; at most two thirds of a cell are allowed. "
                       "Give at least two points along the axis of the "
                       "inflow in 'Points per cell and axis'.")));
    const double ratio = length / points.data(points.box_length, d)[p];
    for (unsigned int e = 0; e < dim; ++e)
      {
        const double factor =
          (e == d ? ratio : std::pow(ratio, -1. / (dim - 1.)));
        points.data(points.edges, e * (dim + 1))[p] *= factor;
        points.data(points.box_length, e)[p] *= factor;
        points.data(points.length_at_creation, e)[p] *= factor;
      }
    points.data(points.inflow_density)[p] =
      points.data(points.mass)[p] / length;
  }



  template <int dim>
  void
  Inflow<dim>::mark_feeding_points()
  {
    if (!is_open())
      return;
    std::vector<unsigned int> n_feeding(faces_.size());
    for (unsigned int p = 0; p < state_.points.size(); ++p)
      if (touches_face(p))
        {
          start_feeding(p);
          ++n_feeding[state_.points.data(state_.points.body)[p]];
        }
    for (unsigned int b = 0; b < faces_.size(); ++b)
      AssertThrow(faces_[b] == numbers::invalid_unsigned_int ||
                    Utilities::MPI::sum(n_feeding[b], state_.communicator()) >
                      0,
                  ExcUser(text("The body '",
                               problem_.bodies().names()[b],
                               "' does not touch the face '",
                               face_names[faces_[b]],
                               "' of its inflow, so there is no opening. "
                               "Let the body begin at the face, with a row of "
                               "points at least.")));
  }



  /// Speed into the mesh at the opening of point @p p, m/s: the mesh moves the
  /// soil at the face with the values of the expression at the nodes, and as
  /// much must enter, whatever the expression is between the nodes.
  template <int dim>
  double
  Inflow<dim>::speed_of_entry(const unsigned int p) const
  {
    const Points<dim> &points = state_.points;
    const unsigned int face = face_of(p), d = face / 2;
    const Point<dim>   x    = load_place(points, points.initial_position, p);
    const Cell<dim>   &cell = state_.grid.cells()[state_.grid.find_cell(x)];
    Point<dim>         unit((x - cell.lower) / cell.size);
    unit[d]      = face % 2;
    double speed = 0.;
    for (unsigned int v = 0; v < power(2, dim); ++v)
      if (const double weight =
            GeometryInfo<dim>::d_linear_shape_function(unit, v);
          weight > 0.)
        speed += weight *
                 problem_.boundaries.normal_velocity(
                   face, cell.vertex(v), state_.time + 0.5 * state_.time_step);
    if (face % 2 == 1)
      speed = -speed;
    AssertThrow(speed >= 0.,
                ExcPoint(text("The velocity of the inflow at (",
                              x,
                              ") m points out of the mesh: ",
                              -speed,
                              " m/s at t = ",
                              state_.time,
                              " s. Give a velocity into the mesh, or 0.")));
    return speed;
  }



  /// The lengths of all edges but the edge along the normal are kept. The shape
  /// of the soil that has entered does not change: the centre moves by half of
  /// the growth towards the face.
  template <int dim>
  void
  Inflow<dim>::grow(const unsigned int p)
  {
    Points<dim>       &points = state_.points;
    const unsigned int face = face_of(p), d = face / 2;
    const double       inwards = (face % 2 == 0 ? 1. : -1.);
    const double       mass    = points.data(points.inflow_density)[p] *
                        speed_of_entry(p) * state_.time_step;
    const double growth = mass / points.data(points.mass)[p];
    const auto   v      = load_vector(points, points.velocity, p);
    const auto  &water  = state_.constants.added_mass;
    const double factor =
      (water.empty() ? 1. : 1. + water[points.data(points.body)[p]]);
    mass_ += mass;
    state_.accounts.impulse("inflow momentum") += mass * v;
    state_.accounts.energy("inflow energy") +=
      0.5 * factor * mass * v.norm_square() +
      growth * (points.data(points.elastic_energy)[p] +
                points.data(points.plastic_work)[p]);
    for (const Column &column : points.columns())
      if (column.inheritance == Inheritance::divided)
        for (unsigned int c = 0; c < column.n_components; ++c)
          points.data(column.first, c)[p] *= 1. + growth;
    for (unsigned int i = 0; i < dim; ++i)
      {
        double &edge = points.data(points.edges, dim * i + d)[p];
        points.data(points.position, i)[p] -= inwards * 0.5 * growth * edge;
        edge *= 1. + growth;
      }
    points.data(points.box_length, d)[p] *= 1. + growth;
    update_box_lengths(points, p, p + 1, state_.constants.box_shape.rule);
  }



  /// Set point @p p, a feeding point, behind the face, with the initial shape
  /// in the plane of the face and the present volume.
  template <int dim>
  void
  Inflow<dim>::take_shape_of_opening(const unsigned int p)
  {
    Points<dim>       &points = state_.points;
    const unsigned int face = face_of(p), d = face / 2;
    double             length = std::abs(determinant(load_edges(points, p)));
    for (unsigned int e = 0; e < dim; ++e)
      if (e != d)
        length /= points.data(points.length_at_creation, e)[p];
    for (unsigned int e = 0; e < dim; ++e)
      {
        for (unsigned int i = 0; i < dim; ++i)
          points.data(points.edges, dim * i + e)[p] = 0.;
        const double of_edge =
          (e == d ? length : points.data(points.length_at_creation, e)[p]);
        points.data(points.edges, e * (dim + 1))[p] = of_edge;
        points.data(points.box_length, e)[p]        = of_edge;
        points.data(points.position, e)[p] =
          points.data(points.initial_position, e)[p];
      }
    points.data(points.position, d)[p] =
      (face % 2 == 0 ? state_.grid.domain().lower[d] + 0.5 * length
                     : state_.grid.domain().upper[d] - 0.5 * length);
  }



  /// Divide point @p p by a plane along the face. Point @p p is the part inside
  /// and flows on; a new point feeds.
  template <int dim>
  void
  Inflow<dim>::divide(const unsigned int p)
  {
    Points<dim>       &points = state_.points;
    const unsigned int face = face_of(p), d = face / 2;
    const double       inwards = (face % 2 == 0 ? 1. : -1.);
    const double       share   = 1. - points.data(points.inflow_density)[p] *
                                points.data(points.length_at_creation, d)[p] /
                                points.data(points.mass)[p];
    const unsigned int q = points.append(1);
    points.copy(p, q);
    points.data(points.id)[q] = splitter_.take_id();
    for (const Column &column : points.columns())
      if (column.inheritance == Inheritance::divided)
        for (unsigned int c = 0; c < column.n_components; ++c)
          {
            points.data(column.first, c)[q] *= share;
            points.data(column.first, c)[p] -= points.data(column.first, c)[q];
          }
    for (unsigned int i = 0; i < dim; ++i)
      {
        double &edge = points.data(points.edges, dim * i + d)[p];
        points.data(points.position, i)[p] += inwards * 0.5 * share * edge;
        edge *= 1. - share;
        points.data(points.edges, dim * i + d)[q] *= share;
      }
    points.data(points.box_length, d)[p] *= 1. - share;
    update_box_lengths(points, p, p + 1, state_.constants.box_shape.rule);
    points.data(points.inflow_density)[p] = 0.;
    take_shape_of_opening(q);
  }



  template <int dim>
  void
  Inflow<dim>::feed()
  {
    if (!is_open())
      return;
    Points<dim>       &points = state_.points;
    const unsigned int n      = points.size();
    for (unsigned int p = 0; p < n; ++p)
      if (points.feeds(p))
        {
          const unsigned int d = face_of(p) / 2;
          grow(p);
          if (points.data(points.mass)[p] >=
              max_mass * points.data(points.inflow_density)[p] *
                points.data(points.length_at_creation, d)[p])
            divide(p);
          if (p < points.n_sorted())
            state_.workspace.points_out_of_cell().push_back(p);
        }
  }



  template <int dim>
  void
  Inflow<dim>::list_quantities(Quantities &list) const
  {
    if (!is_open())
      return;
    list.push_back(
      {"inflow mass", "kg", Utilities::MPI::sum(mass_, state_.communicator())});
    append_vector<dim>(list,
                       "inflow momentum",
                       "kg m/s",
                       Utilities::MPI::sum(state_.accounts.impulse(
                                             "inflow momentum"),
                                           state_.communicator()));
  }



  template <int dim>
  void
  Inflow<dim>::list_state(StateList &list)
  {
    if (is_open())
      list.add("inflow mass", "kg", mass_, Reduction::sum);
  }



  template class Inflow<2>;
  template class Inflow<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/contact/box_extent.h>
#include <talus/grid/node_places.h>
#include <talus/points/points_kernel.h>
#include <talus/water/hydroplaning.h>
#include <talus/water/water.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Thickness of a column with soil [cells]. Thinner soil is a film, whose
    // end is not the nose of the slide.
    constexpr double min_thickness = 0.1;



    /// Axis of space of axis @p i in plan.
    constexpr unsigned int
    axis_in_space(const unsigned int i)
    {
      return i == 0 ? 0 : 2;
    }
  } // namespace



  template <int dim>
  Hydroplaning<dim>::Hydroplaning(const Materials<dim>  &materials,
                                  const Water<dim>      &water,
                                  const Boundaries<dim> &boundaries,
                                  Contact<dim>          &contact)
    : ParameterAcceptor("/Boundaries/Seabed/Hydroplaning")
    , materials_(materials)
    , water_(water)
    , boundaries_(boundaries)
    , contact_(contact)
  {
    add_parameter(
      "Factor",
      factor_,
      "Multiplier of 'Maximum shear stress' of the seabed at the bottom of the "
      "mesh below the nose of a fast slide [-]. A rule of the user for a film "
      "of water that lifts the nose, not a model of the film: no data of a "
      "slide were used to find or check numbers. 1: no rule.",
      this->prm,
      Patterns::Double(0., 1.));
    add_parameter("Distance from the nose",
                  distance_,
                  "The rule acts where the soil ends within this distance "
                  "ahead, along the depth-mean velocity [m].",
                  this->prm,
                  Patterns::Double(0.));
    add_parameter(
      "Densimetric Froude number",
      froude_,
      "The rule acts where the local densimetric Froude number is larger [-]: "
      "depth-mean speed over sqrt((rho_s/rho_w - 1) g h cos a), with the "
      "submerged density of the soil, 'Water/Density', the thickness h of the "
      "soil and gravity across the bottom of the mesh.",
      this->prm,
      Patterns::Double(0.));
  }



  template <int dim>
  void
  Hydroplaning<dim>::check() const
  {
    const std::string section = "Boundaries/Seabed/Hydroplaning/";
    AssertThrow(is_enabled() || (distance_ == 0 && froude_ == 0),
                ExcUser(text("'",
                             section,
                             distance_ > 0 ? "Distance from the nose"
                                           : "Densimetric Froude number",
                             "' is given, but '",
                             section,
                             "Factor' is 1, so that nothing changes. Give a "
                             "factor of less than 1, or remove the entry.")));
    if (!is_enabled())
      return;
    AssertThrow(boundaries_.is_seabed(bottom_face),
                ExcUser(text("'",
                             section,
                             "Factor' is ",
                             factor_,
                             ", but 'Boundaries/Bottom' is not a seabed: the "
                             "rule changes only the seabed at the bottom of "
                             "the mesh, not obstacles. Set 'Boundaries/Bottom' "
                             "to seabed, or remove the factor.")));
    AssertThrow(distance_ > 0 && froude_ > 0,
                ExcUser(text("'",
                             section,
                             "Factor' is ",
                             factor_,
                             ", but '",
                             section,
                             distance_ > 0 ? "Densimetric Froude number"
                                           : "Distance from the nose",
                             "' is 0; the rule needs both, and has no "
                             "defaults. Give a number above 0.")));
  }



  // Columns begin at the lower corner of the mesh, so that nodes lie between
  // columns.
  template <int dim>
  void
  Hydroplaning<dim>::prepare(const Grid<dim> &grid)
  {
    if (!is_enabled())
      return;
    places_ = places_of_owned_nodes(grid);
    size_   = grid.finest_size();
    origin_ = grid.domain().lower;
    for (unsigned int i = 0; i < n_axes; ++i)
      n_[i] = std::lround(grid.domain().length(axis_in_space(i)) / size_);
    nodes_.clear();
    for (unsigned int node = 0; node < grid.n_owned_nodes(); ++node)
      if (grid.faces_of_node(node) & (1u << bottom_face))
        nodes_.push_back(node);
    acts_.assign(grid.n_owned_nodes(), 0);
    contact_.set_share_left([this](const FaceNode<dim> &at) {
      return at.face == bottom_face && acts_[at.node] ? factor_ : 1.;
    });
  }



  /// Distribute point @p p to the columns below its box.
  template <int dim>
  void
  Hydroplaning<dim>::add_point(const State<dim> &state, const unsigned int p)
  {
    const Points<dim>        &points = state.points;
    const auto                x      = load_place(points, points.position, p);
    const auto                v      = load_place(points, points.velocity, p);
    const auto                half   = half_lengths_of_box(points, p);
    const MaterialModel<dim> &material =
      materials_.of_body(points.data(points.body)[p]);
    const double                mass   = points.data(points.mass)[p];
    const std::array<double, 3> values = {
      {volume_of_points<dim, double>(points, p),
       mass,
       mass * material.submerged_density() / material.density()}};
    std::array<long, 2>   first{}, last{};
    std::array<double, 2> lower{}, upper{};
    for (unsigned int i = 0; i < n_axes; ++i)
      {
        const unsigned int d = axis_in_space(i);
        lower[i]             = (x[d] - half[d] - origin_[d]) / size_;
        upper[i]             = (x[d] + half[d] - origin_[d]) / size_;
        first[i] = std::clamp(long(std::floor(lower[i])), 0l, n_[i] - 1);
        last[i]  = std::clamp(long(std::floor(upper[i])), 0l, n_[i] - 1);
      }
    const auto share = [&](const unsigned int i, const long k) {
      const double from = k == first[i] ? lower[i] : k;
      const double to   = k == last[i] ? upper[i] : k + 1;
      return upper[i] > lower[i] ? (to - from) / (upper[i] - lower[i]) : 1.;
    };
    for (long k = first[1]; k <= last[1]; ++k)
      for (long j = first[0]; j <= last[0]; ++j)
        {
          const double part = share(0, j) * (dim == 3 ? share(1, k) : 1.);
          double      *sums =
            sums_.data() + Column::n_values * std::size_t(k * n_[0] + j);
          for (const double value : values)
            *sums++ += part * value;
          for (unsigned int i = 0; i < n_axes; ++i)
            *sums++ += part * mass * v[axis_in_space(i)];
        }
  }



  /// Fill sums_ over all ranks. Collective.
  template <int dim>
  void
  Hydroplaning<dim>::sum_columns(const State<dim> &state)
  {
    std::size_t n_columns = 1;
    for (const long n : n_)
      n_columns *= n;
    sums_.assign(Column::n_values * n_columns, 0.);
    for (unsigned int p = 0; p < state.points.size(); ++p)
      add_point(state, p);
    Utilities::MPI::sum(sums_, state.communicator(), sums_);
  }



  /// Return the column at @p place; without soil if the place is outside of the
  /// mesh.
  template <int dim>
  typename Hydroplaning<dim>::Column
  Hydroplaning<dim>::column_at(const Place &place) const
  {
    Column      result;
    std::size_t number = 0;
    for (unsigned int i = n_axes; i-- > 0;)
      {
        if (place[i] < 0 || place[i] >= n_[i])
          return result;
        number = number * n_[i] + place[i];
      }
    const double *values = sums_.data() + Column::n_values * number;
    result.volume        = *values++;
    result.mass          = *values++;
    result.weight        = *values++;
    for (double &momentum : result.momentum)
      momentum = *values++;
    return result;
  }



  template <int dim>
  bool
  Hydroplaning<dim>::has_soil(const Column &column) const
  {
    return column.volume > min_thickness * std::pow(size_, dim);
  }



  /// Return whether the rule acts at the node at @p x, which lies between two
  /// columns (in 3-D four). Columns without soil do not count.
  template <int dim>
  bool
  Hydroplaning<dim>::is_at_nose(const State<dim> &state,
                                const Point<dim> &x) const
  {
    const auto column_of = [this](const Point<dim> &y) {
      Place place;
      for (unsigned int i = 0; i < n_axes; ++i)
        {
          const unsigned int d = axis_in_space(i);
          place[i]             = std::floor((y[d] - origin_[d]) / size_);
        }
      return column_at(place);
    };
    Column       around;
    unsigned int n_columns = 0;
    for (unsigned int v = 0; v < (1u << n_axes); ++v)
      {
        Point<dim> y = x;
        for (unsigned int i = 0; i < n_axes; ++i)
          y[axis_in_space(i)] += (v & (1u << i) ? 0.5 : -0.5) * size_;
        const Column column = column_of(y);
        if (!has_soil(column))
          continue;
        ++n_columns;
        around.mass += column.mass;
        around.weight += column.weight;
        for (unsigned int i = 0; i < n_axes; ++i)
          around.momentum[i] += column.momentum[i];
      }
    if (n_columns == 0)
      return false;
    Tensor<1, dim> velocity;
    for (unsigned int i = 0; i < n_axes; ++i)
      velocity[axis_in_space(i)] = around.momentum[i] / around.mass;
    const double speed = velocity.norm();
    // Pressure of the submerged weight over the density of the water.
    const double buoyant = -state.constants.gravity[1] * around.weight /
                           (n_columns * std::pow(size_, dim - 1.)) /
                           water_.density();
    if (!(buoyant > 0) || speed * speed <= froude_ * froude_ * buoyant)
      return false;
    const Tensor<1, dim> step = velocity / speed * size_;
    // The distance of an end on a border of columns may have round-off.
    for (unsigned int k = 0; k * size_ <= distance_ * (1. + 1e-12); ++k)
      if (!has_soil(column_of(x + (k + 0.5) * step)))
        return true;
    return false;
  }



  template <int dim>
  void
  Hydroplaning<dim>::begin_step(State<dim> &state)
  {
    if (!is_enabled())
      return;
    sum_columns(state);
    for (const unsigned int node : nodes_)
      acts_[node] = is_at_nose(state, places_[node]);
  }



  /// Return the part of the seabed where the rule acts, over all ranks.
  /// Collective.
  template <int dim>
  typename Hydroplaning<dim>::Extent
  Hydroplaning<dim>::extent(const State<dim> &state) const
  {
    Extent result{0.,
                  std::numeric_limits<double>::max(),
                  std::numeric_limits<double>::lowest()};
    for (const unsigned int node : nodes_)
      if (acts_[node])
        {
          result.area += state.grid.face_share(bottom_face, node).area;
          result.from = std::min(result.from, places_[node][0]);
          result.to   = std::max(result.to, places_[node][0]);
        }
    const MPI_Comm communicator = state.communicator();
    result.area = Utilities::MPI::sum(result.area, communicator);
    result.from = Utilities::MPI::min(result.from, communicator);
    result.to   = Utilities::MPI::max(result.to, communicator);
    return result;
  }



  template <int dim>
  void
  Hydroplaning<dim>::list_quantities(const State<dim> &state,
                                     Quantities       &list) const
  {
    if (is_enabled())
      list.push_back(
        {"hydroplaning seabed", dim == 2 ? "m" : "m^2", extent(state).area});
  }



  template <int dim>
  std::vector<std::string>
  Hydroplaning<dim>::notes() const
  {
    if (!is_enabled())
      return {};
    return {
      text("'Boundaries/Seabed/Hydroplaning' multiplies the maximum shear "
           "stress of the seabed by ",
           factor_,
           " within ",
           distance_,
           " m of the nose where the densimetric Froude number exceeds ",
           froude_,
           ". This is a rule of the parameter file: talus has no data "
           "that support its numbers. Compare with a run without it.")};
  }



  template <int dim>
  std::string
  Hydroplaning<dim>::report(const State<dim> &state) const
  {
    if (!is_enabled())
      return "";
    const Extent where = extent(state);
    return where.area > 0 ? text(std::setprecision(4),
                                 "At t = ",
                                 state.time,
                                 " s the rule of hydroplaning acts on ",
                                 where.area,
                                 dim == 2 ? " m" : " m^2",
                                 " of the seabed between x = ",
                                 where.from,
                                 " m and x = ",
                                 where.to,
                                 " m; 'hydroplaning seabed' of statistics.csv "
                                 "tells when it acts later.")
                          : "";
  }



  template class Hydroplaning<2>;
  template class Hydroplaning<3>;
} // namespace talus

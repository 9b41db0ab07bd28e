// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/simulation/time_step.h>
#include <talus/transfer/weights_kernel.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the larger number; a NaN is returned, and then stays.
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    larger_or_none(const Number &a, const Number &b)
    {
      return select((a < b) | (b != b), b, a);
    }



    /// Half distance between opposite sides of the box(es) of point(s) @p p, in
    /// cells, clamped as in the weights. The sides of a convected domain at the
    /// ends of edge d have the normal A^-T e_d.
    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE std::array<Number, dim>
    half_widths_in_cells(const PointsView<dim, const double> &points,
                         const BoxShape                      &shape,
                         const unsigned int                   p,
                         const Number                        &inverse_cell_size)
    {
      std::array<Number, dim> half;
      if (shape.rule != BoxRule::convected_domain)
        {
          for (unsigned int d = 0; d < dim; ++d)
            half[d] =
              half_length_in_cells<dim>(points, shape, d, p, inverse_cell_size);
          return half;
        }
      const Matrix<dim, Number> normals =
        inverse(load_matrix<dim, Number>(points, points.edges, p));
      for (unsigned int d = 0; d < dim; ++d)
        {
          Number square = normals[d][0] * normals[d][0];
          for (unsigned int i = 1; i < dim; ++i)
            square += normals[d][i] * normals[d][i];
          half[d] = clamp(0.5 / sqrt(square) * inverse_cell_size,
                          shape.min_half,
                          shape.max_half);
        }
      return half;
    }



    /// Upper bound of the largest (omega h/c)^2 at a free surface just beyond a
    /// face of the cells, for boxes of half length h/@p beta (doc/method.md,
    /// section 8).
    template <typename Number>
    TALUS_ALWAYS_INLINE Number
    eigenvalue_at_surface(const Number &beta)
    {
      const Number half = 0.5 * beta;
      return 2. + half + sqrt((2. - half) * (2. - half) + 6.);
    }
  } // namespace



  template <int dim>
  TimeStep<dim>::TimeStep()
    : ParameterAcceptor("/Time step")
  {
    add_parameter("CFL number",
                  cfl_number_,
                  "Largest fraction of a cell that a wave, carried by the "
                  "moving soil, crosses in a step [-]. Soil with a free "
                  "surface is stable up to 0.6 with one box per cell and axis, "
                  "0.56 with two, 0.47 with four and 0.43 with the thinnest "
                  "boxes; the time step never exceeds this limit, and log.txt "
                  "names the limiting bound.",
                  this->prm,
                  Patterns::Double(1e-6, 1.));
    add_parameter(
      "Box safety factor",
      box_safety_factor_,
      "Fraction of the stability limit of thin boxes, 2 (h/c)/sqrt(sum over "
      "axes of h/l) with l the half length of the box, or half of the width "
      "between opposite sides of a convected domain [-].",
      this->prm,
      Patterns::Double(1e-6, 1.));
    add_parameter("Maximum",
                  maximum_,
                  "Maximum time step [s]; 0: no limit.",
                  this->prm,
                  Patterns::Double(0.));
  }



  // Squares are used, because divisions and square roots take most of the time:
  // with c^2 = M V/m, and the sum of the inverse half lengths as a single
  // fraction, one division and one root suffice.
  template <int dim>
  template <typename Number>
  TALUS_ALWAYS_INLINE typename TimeStep<dim>::template Bounds<Number>
  TimeStep<dim>::bounds_at(const PointsView<dim, const double> &points,
                           const BoxShape                      &shape,
                           const unsigned int                   p,
                           const Number                        &wave_modulus,
                           const Number &inverse_cell_size) const
  {
    const auto half_widths =
      half_widths_in_cells<dim>(points, shape, p, inverse_cell_size);
    Number speed_square(0.), numerator(0.), product(1.), thinnest(1.);
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Number v = load<Number>(points.data(points.velocity, d) + p);
        speed_square += v * v;
        const Number &half = half_widths[d];
        numerator          = numerator * half + product;
        product *= half;
        thinnest = min(thinnest, half);
      }
    const auto   mass     = load<Number>(points.data(points.mass) + p);
    const Number fraction = wave_modulus *
                            volume_of_points<dim, Number>(points, p) /
                            (mass * product);
    const Number wave_square = fraction * product;
    const Number h_square    = inverse_cell_size * inverse_cell_size;
    const double by_cfl = 1. / cfl_number_, by_box = 0.5 / box_safety_factor_;
    return {
      {{(wave_square + speed_square + 2. * sqrt(wave_square * speed_square)) *
          (h_square * (by_cfl * by_cfl)),
        fraction * numerator * (h_square * (by_box * by_box)),
        0.5 * wave_square * h_square * eigenvalue_at_surface(1. / thinnest)}},
      speed_square};
  }



  /// For the error message: describe the first point with a non-finite value
  /// needed for the time step, or with a volume that is not positive.
  template <int dim>
  std::string
  TimeStep<dim>::first_without_bound(const Points<dim>    &points,
                                     const Materials<dim> &materials) const
  {
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          const double volume = volume_of_points<dim, double>(points, p);
          double       sum =
            materials.of_body(segment.body).wave_speed(points, p) + volume;
          for (unsigned int d = 0; d < dim; ++d)
            sum += points.data(points.velocity, d)[p] +
                   points.data(points.box_length, d)[p];
          if (!std::isfinite(sum) || !(volume > 0))
            return text("point ",
                        points.data(points.id)[p],
                        " at (",
                        load_place(points, points.position, p),
                        ") m");
        }
    return "a point that could not be found";
  }



  /// Collect data of a batch not stored with the points: the modulus of the
  /// fastest wave, and the inverse cell size.
  template <int dim>
  void
  TimeStep<dim>::find_moduli_and_sizes(const Points<dim>    &points,
                                       const Batch          &batch,
                                       const Grid<dim>      &grid,
                                       const Materials<dim> &materials)
  {
    const unsigned int n = batch.end - batch.begin;
    if (wave_modulus_.size() < n + Points<dim>::n_spare)
      {
        wave_modulus_.resize(n + Points<dim>::n_spare);
        inverse_cell_size_.resize(n + Points<dim>::n_spare);
      }
    materials.for_each_material_range(points,
                                      batch,
                                      [&](const MaterialModel<dim> &model,
                                          const unsigned int        begin,
                                          const unsigned int        end) {
                                        model.wave_modulus(
                                          points,
                                          begin,
                                          end,
                                          &wave_modulus_[begin - batch.begin]);
                                      });
    for (const Segment &segment : points.segments(batch))
      {
        // Stores whole registers; the next segment overwrites the excess.
        using Number              = Simd<simd_width>;
        const Number inverse_size = 1. / grid.cells()[segment.cell].size;
        for (unsigned int p = segment.begin; p < segment.end; p += simd_width)
          store(&inverse_cell_size_[p - batch.begin], inverse_size);
      }
  }



  /// The bound is stored as the maximum of 1/dt^2 (doc/method.md, section 8):
  /// bounds are compared without a root or a division for each. Moduli are
  /// evaluated by ranges of the same material, and cell sizes are copied to the
  /// points, so the loop over points has no branches and uses whole registers.
  template <int dim>
  void
  TimeStep<dim>::add_batch(const Points<dim>    &points,
                           const Batch          &batch,
                           const Grid<dim>      &grid,
                           const Materials<dim> &materials,
                           const BoxShape       &shape)
  {
    find_moduli_and_sizes(points, batch, grid, materials);
    const auto       columns = points.view();
    Simd<simd_width> largest(largest_), speed_square(0.);
    Simd<1>          largest_of_rest(largest_), speed_square_of_rest(0.);
    for_each_simd(
      batch.begin,
      batch.end,
      [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
        using Number                = decltype(number);
        const unsigned int k        = p - batch.begin;
        const auto         at       = bounds_at<Number>(columns,
                                          shape,
                                          p,
                                          load<Number>(&wave_modulus_[k]),
                                          load<Number>(&inverse_cell_size_[k]));
        constexpr bool     is_whole = std::is_same_v<Number, Simd<simd_width>>;
        for (const Number &bound : at.inverse_squares)
          if constexpr (is_whole)
            largest = larger_or_none(largest, bound);
          else
            largest_of_rest = larger_or_none(largest_of_rest, bound);
        if constexpr (is_whole)
          speed_square = max(speed_square, at.speed_square);
        else
          speed_square_of_rest = max(speed_square_of_rest, at.speed_square);
      });
    // A maximum does not depend on the order, and thus not on the width of the
    // registers.
    largest_ = largest_of_rest[0];
    largest_speed_square_ =
      std::max(largest_speed_square_, speed_square_of_rest[0]);
    for (unsigned int i = 0; i < simd_width; ++i)
      {
        largest_ = larger_or_none(largest_, largest[i]);
        largest_speed_square_ =
          std::max(largest_speed_square_, speed_square[i]);
      }
  }



  /// Evaluate all points at once, for the start and for tests.
  template <int dim>
  double
  TimeStep<dim>::choose(const Points<dim>    &points,
                        const Grid<dim>      &grid,
                        const Materials<dim> &materials,
                        const BoxShape       &shape)
  {
    begin();
    points.for_each_batch([&](const Batch &batch) {
      add_batch(points, batch, grid, materials, shape);
    });
    return stable_time_step(points, materials);
  }



  template <int dim>
  double
  TimeStep<dim>::stable_time_step(const Points<dim>    &points,
                                  const Materials<dim> &materials) const
  {
    // Infinite without points.
    const double dt = 1. / std::sqrt(largest_);
    AssertThrow((std::isfinite(dt) || points.size() == 0) && dt > 0,
                ExcPoint(
                  text("No time step can be chosen (it would be ",
                       dt,
                       " s): velocity, wave speed, volume or box length are "
                       "not finite and positive at ",
                       first_without_bound(points, materials),
                       ". The simulation became unstable: lower 'Time "
                       "step/CFL number'.")));
    return maximum_ > 0 ? std::min(dt, maximum_) : dt;
  }



  /// Searches for the point of the largest bound point by point: the step
  /// itself stores the bound only, and words are needed only for the log. Valid
  /// on the first rank. Collective.
  template <int dim>
  std::string
  TimeStep<dim>::limited_by(const Points<dim>    &points,
                            const Grid<dim>      &grid,
                            const Materials<dim> &materials,
                            const BoxShape       &shape) const
  {
    const std::array<const char *, 3> reasons = {
      {"the wave and flow speed at point ",
       "the thin box of point ",
       "the stability of free surfaces, below 'Time step/CFL number', at the "
       "box of point "}};
    double      largest = by_strain_;
    std::string reason =
      text("the largest velocity gradient: a step strains soil by ",
           max_strain,
           " at most");
    for (const Segment &segment : points.segments())
      for (unsigned int p = segment.begin; p < segment.end; ++p)
        {
          const auto &material = materials.of_body(segment.body);
          double      modulus;
          material.wave_modulus(points, p, p + 1, &modulus);
          const auto bounds =
            bounds_at<double>(points.view(),
                              shape,
                              p,
                              modulus,
                              1. / grid.cells()[segment.cell].size)
              .inverse_squares;
          const unsigned int which =
            std::max_element(bounds.begin(), bounds.end()) - bounds.begin();
          if (bounds[which] <= largest)
            continue;
          largest = bounds[which];
          reason  = text(reasons[which],
                        points.data(points.id)[p],
                        " (wave speed ",
                        std::setprecision(6),
                        material.wave_speed(points, p),
                        " m/s)");
        }
    // Among ranks with the shortest step, the first rank determines the reason.
    const auto all =
      Utilities::MPI::gather(grid.communicator(),
                             std::pair<double, std::string>(largest, reason));
    for (const auto &[bound, reason_there] : all)
      if (bound > largest)
        {
          largest = bound;
          reason  = reason_there;
        }
    if (maximum_ > 0 && 1. / std::sqrt(largest) > maximum_)
      return "'Time step/Maximum'";
    return reason;
  }



  void
  check_time_advances(const double                        time,
                      const double                        dt,
                      const std::function<std::string()> &limited_by)
  {
    AssertThrow(time + dt > time,
                ExcPoint(text("At t = ",
                              time,
                              " s the time step is only ",
                              dt,
                              " s, limited by ",
                              limited_by(),
                              ", so that time stands still. The simulation "
                              "became unstable: lower 'Time step/CFL number', "
                              "or check the point in the last state.")));
  }



  template class TimeStep<2>;
  template class TimeStep<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_time_step_h
#define talus_simulation_time_step_h

#include <talus/grid/grid.h>
#include <talus/materials/materials.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>

namespace talus
{
  /// Time step of the explicit scheme, with the fastest wave speed c at a
  /// point, speed v of the point, cell size h, and clipped half lengths l_d of
  /// the box:
  ///   dt = min over points of  cfl h/(c + |v|)  and
  ///                            safety 2 (h/c)/sqrt(sum_d h/l_d),
  ///                            (h/c) sqrt(2/lambda(max_d h/l_d)).
  /// The second bound is the stability limit of a thin box, whose nodal mass
  /// decreases with l while the stiffness does not. The third bound is the
  /// stability limit of a free surface just beyond a face of the cells. A
  /// fourth bound limits the strain of a step: single points in the air are
  /// unstable at the other bounds, and would be turned inside out.
  template <int dim>
  class TimeStep : public dealii::ParameterAcceptor
  {
  public:
    TimeStep();

    /// Start a new minimum over points. The norm of the strain per step at the
    /// @p max_velocity_gradient, 1/s, must not exceed `max_strain`.
    void
    begin(const double max_velocity_gradient = 0)
    {
      const double inverse = max_velocity_gradient / max_strain;
      largest_ = by_strain_ = inverse * inverse;
      largest_speed_square_ = 0;
    }

    /// Include the points of a batch in the minimum.
    ///
    /// @param points material points
    /// @param batch range of points
    /// @param grid with the cell sizes
    /// @param materials with the wave moduli
    /// @param shape of the boxes
    void
    add_batch(const Points<dim>    &points,
              const Batch          &batch,
              const Grid<dim>      &grid,
              const Materials<dim> &materials,
              const BoxShape       &shape);

    /// Stable time step of the points added since begin(), s; infinite without
    /// points. Throws ExcPoint if the result is not positive.
    double
    stable_time_step(const Points<dim>    &points,
                     const Materials<dim> &materials) const;

    /// Maximum speed of the points added since begin(), m/s.
    double
    max_speed() const
    {
      return std::sqrt(largest_speed_square_);
    }

    /// Stable time step of all points of the local rank, s.
    double
    choose(const Points<dim>    &points,
           const Grid<dim>      &grid,
           const Materials<dim> &materials,
           const BoxShape       &shape);

    /// Sentence naming the bound and the point that limit the current time
    /// step; valid on the first rank. Collective.
    std::string
    limited_by(const Points<dim>    &points,
               const Grid<dim>      &grid,
               const Materials<dim> &materials,
               const BoxShape       &shape) const;

  private:
    void
    find_moduli_and_sizes(const Points<dim>    &points,
                          const Batch          &batch,
                          const Grid<dim>      &grid,
                          const Materials<dim> &materials);

    template <typename Number>
    struct Bounds
    {
      std::array<Number, 3> inverse_squares; ///< bounds on dt, 1/s^2
      Number                speed_square;    ///< m^2/s^2
    };

    /// Three bounds on the time step at point(s) p, and speed of the point(s).
    template <typename Number>
    Bounds<Number>
    bounds_at(const PointsView<dim, const double> &points,
              const BoxShape                      &shape,
              unsigned int                         p,
              const Number                        &wave_modulus,
              const Number                        &inverse_cell_size) const;

    /// Identify the first point with a value that is not finite.
    std::string
    first_without_bound(const Points<dim>    &points,
                        const Materials<dim> &materials) const;

    /// Maximum norm of the displacement gradient of a step [-].
    static constexpr double max_strain = 0.1;

    double cfl_number_        = 0.4;
    double box_safety_factor_ = 0.9;
    double maximum_           = 0.;

    /// Maximum inverse square of a bound so far, 1/s^2.
    double largest_              = 0;
    double by_strain_            = 0; ///< bound by the strain, 1/s^2
    double largest_speed_square_ = 0; ///< m^2/s^2

    // Scratch data of a batch.
    std::vector<double> wave_modulus_;
    std::vector<double> inverse_cell_size_;
  };



  /// Throw ExcPoint if @p time + @p dt is not later than @p time, s: a step
  /// lost in round-off would continue the run for ever. @p limited_by is called
  /// only in case of error.
  void
  check_time_advances(double                              time,
                      double                              dt,
                      const std::function<std::string()> &limited_by);
} // namespace talus

#endif

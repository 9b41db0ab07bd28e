// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_simulation_time_step_h
#define talus_simulation_time_step_h

#include <talus/grid/grid.h>
#include <talus/materials/materials.h>
#include <talus/transfer/box_rule.h>

#include <deal.II/base/parameter_acceptor.h>

#include <functional>
#include <string>

namespace talus
{
  /// Chooses the time step of the explicit scheme: with c the speed of the
  /// fastest wave at a point, v its speed, h its cell and l_d the clipped half
  /// lengths of its box,
  ///   dt = min over points of  cfl h/(c + |v|)  and
  ///                            safety 2 (h/c)/sqrt(sum_d h/l_d),
  ///                            (h/c) sqrt(2/lambda(max_d h/l_d)).
  /// The second bound is the stability limit of a thin box: its mass on the
  /// nodes falls with l, its stiffness does not. The third one is that of a free
  /// surface just beyond a face of the cells.
  template <int dim>
  class TimeStep : public dealii::ParameterAcceptor
  {
  public:
    TimeStep();

    /// Forget all points.
    void
    begin()
    {
      largest_ = 0;
    }

    /// Take the points of a batch into account.
    void
    add_batch(const Points<dim>    &points,
              const Batch          &batch,
              const Grid<dim>      &grid,
              const Materials<dim> &materials,
              const BoxShape       &shape);

    /// The step that the points added since begin() allow, s; infinite if there
    /// are none. Throws ExcPoint if it is not a positive number.
    double
    stable_time_step(const Points<dim>    &points,
                     const Materials<dim> &materials) const;

    /// The step that all points of this rank allow.
    double
    choose(const Points<dim>    &points,
           const Grid<dim>      &grid,
           const Materials<dim> &materials,
           const BoxShape       &shape);

    /// Sentence that names what limits the step in this state, right on the
    /// first rank. Collective.
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

    /// Squares of the inverse of the three bounds at point(s) p, 1/s^2.
    template <typename Number>
    std::array<Number, 3>
    inverse_squares(const PointsView<dim, const double> &points,
                    const BoxShape                      &shape,
                    unsigned int                         p,
                    const Number                        &wave_modulus,
                    const Number &inverse_cell_size) const;

    /// Name and place of the first point whose speed is not finite.
    std::string
    first_without_bound(const Points<dim>    &points,
                        const Materials<dim> &materials) const;

    double cfl_number_        = 0.4;
    double box_safety_factor_ = 0.9;
    double maximum_           = 0.;

    /// The largest inverse square of a bound so far, 1/s^2.
    double largest_ = 0;

    // Of a batch.
    std::vector<double> wave_modulus_;
    std::vector<double> inverse_cell_size_;
  };



  /// Throw ExcPoint if @p time + @p dt is not later than @p time, s, as with a
  /// step that is lost in round-off: the run would go on for ever. Only then
  /// what limits the step is asked for.
  void
  check_time_goes_on(double                              time,
                     double                              dt,
                     const std::function<std::string()> &limited_by);
} // namespace talus

#endif

#include <talus/base/errors.h>
#include <talus/points/points_kernel.h>
#include <talus/transfer/transfer.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Transfer<dim>::Transfer()
    : ParameterAcceptor("/Transfer")
  {
    add_parameter("FLIP fraction",
                  flip_fraction_,
                  "Share of the old velocity plus the increment of the grid "
                  "(FLIP) in the new velocity of a point; the rest is the "
                  "velocity of the grid (PIC), which damps [-].",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter("Box rule",
                  box_rule_,
                  "How the box of a point follows its deformation: 'fixed' "
                  "(uniform GIMP; the daughters of a split then do not tile "
                  "their parent), 'deformation gradient' (F_dd), 'right "
                  "stretch' (U_dd of F = R U) or 'left stretch' (V_dd of "
                  "F = V R).",
                  this->prm,
                  Patterns::Selection(
                    "fixed|deformation gradient|right stretch|left stretch"));
    add_parameter(
      "Minimum half-size",
      box_shape_.least_half,
      "Half of the length of a box is clipped to at least this many "
      "cell sizes for the weights; thinner boxes would lower the "
      "stable time step [-].",
      this->prm,
      Patterns::Double(1e-3, 0.5));
    add_parameter("Maximum half-size",
                  box_shape_.most_half,
                  "Half of the length of a box is clipped to at most this many "
                  "cell sizes for the weights; a longer box would reach beyond "
                  "the cells around its own [-].",
                  this->prm,
                  Patterns::Double(1e-3, 0.5));
    add_parameter("Mass cut-off",
                  mass_cut_off_,
                  "Nodes with less mass than this fraction of a full cell's "
                  "carry nothing [-]. A large value acts as a wall in front of "
                  "the slide.",
                  this->prm,
                  Patterns::Double(0., 1e-3));
    parse_parameters_call_back.connect([this]() {
      box_shape_.rule = box_rule_ == "fixed" ? BoxRule::fixed
                        : box_rule_ == "deformation gradient"
                          ? BoxRule::deformation_gradient
                        : box_rule_ == "left stretch" ? BoxRule::left_stretch
                                                      : BoxRule::right_stretch;
    });
  }



  template <int dim>
  void
  Transfer<dim>::check() const
  {
    AssertThrow(box_shape_.least_half <= box_shape_.most_half,
                ExcUser(text("Transfer/Minimum half-size = ",
                             box_shape_.least_half,
                             " must not exceed Transfer/Maximum half-size = ",
                             box_shape_.most_half,
                             ".")));
  }



  template <int dim>
  double
  Transfer<dim>::least_mass(const double density, const double cell_size) const
  {
    return mass_cut_off_ * density * std::pow(cell_size, dim);
  }



  template <int dim>
  bool
  Transfer<dim>::takes_cell_mean(const Points<dim> &points,
                                 const Batch       &batch) const
  {
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      if (cell_mean_of_body_[points.segments()[s].body])
        return true;
    return false;
  }



  template <int dim>
  void
  Transfer<dim>::subtract_from_mean(const Points<dim> &points,
                                    const Batch       &batch,
                                    const double      *volume,
                                    double            *quantity) const
  {
    for (unsigned int s = batch.first_segment; s < batch.last_segment; ++s)
      {
        const Segment     &segment = points.segments()[s];
        const unsigned int begin   = segment.begin - batch.begin;
        const unsigned int end     = segment.end - batch.begin;
        if (!cell_mean_of_body_[segment.body])
          {
            std::fill(quantity + begin, quantity + end, 0.);
            continue;
          }
        double sum = 0, sum_of_volumes = 0;
        for (unsigned int k = begin; k < end; ++k)
          {
            sum += volume[k] * quantity[k];
            sum_of_volumes += volume[k];
          }
        const double mean = sum / sum_of_volumes;
        for (unsigned int k = begin; k < end; ++k)
          quantity[k] = mean - quantity[k];
      }
  }



  // Both means are weighted with the volume at the start of the step and taken
  // over the same points: only then is the pair adjoint,
  // sum V sigma : D' = sum V sigma' : D, and no energy appears.

  template <int dim>
  void
  Transfer<dim>::average_mean_stress(const Points<dim>  &points,
                                     StepWorkspace<dim> &workspace,
                                     const Batch        &batch) const
  {
    double *const shift  = workspace.mean_stress_shift();
    double *const volume = workspace.scratch(0);
    if (!takes_cell_mean(points, batch))
      {
        std::fill_n(shift, batch.end - batch.begin, 0.);
        return;
      }
    const auto columns = points.view();
    for_each_simd(batch.begin,
                  batch.end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number = decltype(number);
                    Number q(0.);
                    for (unsigned int d = 0; d < dim; ++d)
                      q += load<Number>(columns.data(columns.stress, d) + p);
                    const unsigned int k = p - batch.begin;
                    store(shift + k, q * (1. / dim));
                    store(volume + k,
                          volume_of_points<dim, Number>(columns, p));
                  });
    subtract_from_mean(points, batch, volume, shift);
  }



  template <int dim>
  void
  Transfer<dim>::average_dilatation(const Points<dim>  &points,
                                    StepWorkspace<dim> &workspace,
                                    const Batch        &batch) const
  {
    if (!takes_cell_mean(points, batch))
      return;
    const auto    columns = points.view();
    const auto    work    = workspace.view(batch.begin, batch.end);
    double *const volume  = workspace.scratch(0);
    double *const rate    = workspace.scratch(1);
    for_each_simd(batch.begin,
                  batch.end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number         = decltype(number);
                    const unsigned int k = p - batch.begin;
                    store(rate + k,
                          trace(load_velocity_gradient<dim, Number>(work, p)));
                    store(volume + k,
                          volume_of_points<dim, Number>(columns, p));
                  });
    subtract_from_mean(points, batch, volume, rate);
    for (unsigned int d = 0; d < dim; ++d)
      {
        double *const L_dd = workspace.velocity_gradient(d, d);
        for (unsigned int k = 0; k < batch.end - batch.begin; ++k)
          L_dd[k] += rate[k] * (1. / dim);
      }
  }



  template Transfer<2>::Transfer();
  template Transfer<3>::Transfer();
  template void
  Transfer<2>::check() const;
  template void
  Transfer<3>::check() const;
  template double
  Transfer<2>::least_mass(double, double) const;
  template double
  Transfer<3>::least_mass(double, double) const;
  template void
  Transfer<2>::average_mean_stress(const Points<2> &,
                                   StepWorkspace<2> &,
                                   const Batch &) const;
  template void
  Transfer<3>::average_mean_stress(const Points<3> &,
                                   StepWorkspace<3> &,
                                   const Batch &) const;
  template void
  Transfer<2>::average_dilatation(const Points<2> &,
                                  StepWorkspace<2> &,
                                  const Batch &) const;
  template void
  Transfer<3>::average_dilatation(const Points<3> &,
                                  StepWorkspace<3> &,
                                  const Batch &) const;
} // namespace talus

#include <talus/base/errors.h>
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



  namespace
  {
    template <int dim>
    inline double
    volume_of_point(const Points<dim> &points, const unsigned int p)
    {
      return points.data(points.reference_volume)[p] *
             determinant(load_matrix<dim, double>(points,
                                                  points.deformation_gradient,
                                                  p));
    }
  } // namespace



  // Both means are weighted with the volume at the start of the step and taken
  // over the same points: only then is the pair adjoint,
  // sum V sigma : D' = sum V sigma' : D, and no energy appears.

  template <int dim>
  void
  Transfer<dim>::average_mean_stress(Points<dim> &points) const
  {
    double *shift = points.mean_stress_shift();
    for (const Segment &segment : points.segments())
      {
        if (!cell_mean_of_body_[segment.body])
          {
            std::fill(shift + segment.begin, shift + segment.end, 0.);
            continue;
          }
        double sum_q = 0, sum_volume = 0;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            double q = 0;
            for (unsigned int d = 0; d < dim; ++d)
              q += points.data(points.stress, d)[p];
            q /= dim;
            const double volume = volume_of_point(points, p);
            sum_q += volume * q;
            sum_volume += volume;
            shift[p] = -q;
          }
        const double mean = sum_q / sum_volume;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          shift[p] += mean;
      }
  }



  template <int dim>
  void
  Transfer<dim>::average_dilatation(Points<dim> &points) const
  {
    for (const Segment &segment : points.segments())
      {
        if (!cell_mean_of_body_[segment.body])
          continue;
        double sum_rate = 0, sum_volume = 0;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            double rate = 0;
            for (unsigned int d = 0; d < dim; ++d)
              rate += points.velocity_gradient(d, d)[p];
            const double volume = volume_of_point(points, p);
            sum_rate += volume * rate;
            sum_volume += volume;
          }
        const double mean = sum_rate / sum_volume;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            double rate = 0;
            for (unsigned int d = 0; d < dim; ++d)
              rate += points.velocity_gradient(d, d)[p];
            for (unsigned int d = 0; d < dim; ++d)
              points.velocity_gradient(d, d)[p] += (mean - rate) / dim;
          }
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
  Transfer<2>::average_mean_stress(Points<2> &) const;
  template void
  Transfer<3>::average_mean_stress(Points<3> &) const;
  template void
  Transfer<2>::average_dilatation(Points<2> &) const;
  template void
  Transfer<3>::average_dilatation(Points<3> &) const;
} // namespace talus

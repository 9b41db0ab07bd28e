// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/adaptivity/conservation_check.h>

#include <algorithm>
#include <cmath>

namespace talus
{
  // Children tile their parent, so a split changes the sums by round-off only.
  // A larger error is an error in the program, for example an energy that is
  // copied where division is due. The check costs a few operations per split
  // and runs always.
  template <int dim>
  void
  ConservationCheck<dim>::add(const Points<dim> &points,
                              const unsigned int p,
                              const double       sign)
  {
    const double mass         = points.data(points.mass)[p];
    double       speed_square = 0, distance_square = 0;

    std::array<double, n_entries> entry, scale;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double v = points.data(points.velocity, d)[p];
        const double x = points.data(points.position, d)[p];
        speed_square += v * v;
        distance_square += x * x;
        entry[d]       = mass * v;
        entry[dim + d] = mass * x;
      }
    // Scale vectors by their length, as a single component may well be zero.
    for (unsigned int d = 0; d < dim; ++d)
      {
        scale[d]       = mass * std::sqrt(speed_square);
        scale[dim + d] = mass * std::sqrt(distance_square);
      }
    entry[2 * dim]        = mass;
    entry[kinetic_energy] = 0.5 * mass * speed_square;
    entry[2 * dim + 2]    = points.data(points.elastic_energy)[p];
    for (unsigned int i = 2 * dim; i < n_entries; ++i)
      scale[i] = std::abs(entry[i]);

    // Each split is counted before and after, hence half of both for the scale.
    for (unsigned int i = 0; i < n_entries; ++i)
      {
        difference_[i] += sign * entry[i];
        scale_[i] += 0.5 * scale[i];
      }
  }



  // Relative to the sum of absolute values, as the plain sum may vanish.
  template <int dim>
  double
  ConservationCheck<dim>::relative_error() const
  {
    double error = 0;
    for (unsigned int i = 0; i < n_entries; ++i)
      if (scale_[i] > 0)
        error = std::max(error, std::abs(difference_[i]) / scale_[i]);
    return error;
  }



  // The unit is left empty: the entries have different units.
  template <int dim>
  void
  ConservationCheck<dim>::list_state(StateList &list, const std::string &name)
  {
    list.add_components(
      name + " difference", "", difference_, n_entries, Reduction::sum);
    list.add_components(name + " scale", "", scale_, n_entries, Reduction::sum);
  }



  template class ConservationCheck<2>;
  template class ConservationCheck<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/outflow.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  template <int dim>
  void
  Outflow<dim>::open(const std::array<bool, 2 * dim> &is_open)
  {
    faces_ = is_open;
  }



  template <int dim>
  bool
  Outflow<dim>::is_open() const
  {
    return std::any_of(faces_.begin(), faces_.end(), [](const bool is_open) {
      return is_open;
    });
  }



  template <int dim>
  bool
  Outflow<dim>::is_beyond(const Point<dim> &x, const Box<dim> &domain) const
  {
    bool is_beyond = false;
    for (unsigned int d = 0; d < dim; ++d)
      is_beyond = is_beyond || (faces_[2 * d] && x[d] < domain.lower[d]) ||
                  (faces_[2 * d + 1] && x[d] >= domain.upper[d]);
    return is_beyond && numbers::is_finite(x.norm_square());
  }



  template <int dim>
  void
  Outflow<dim>::record(const Points<dim>         &points,
                       const unsigned int         p,
                       const std::vector<double> &added_mass)
  {
    const double mass     = points.data(points.mass)[p];
    const auto   velocity = load_place(points, points.velocity, p);
    const double water =
      added_mass.empty() ? 0. : added_mass[points.data(points.body)[p]];
    ++n_points_;
    mass_ += mass;
    momentum_ += mass * Tensor<1, dim>(velocity);
    energy_ += 0.5 * (1. + water) * mass * velocity.norm_square() +
               points.data(points.elastic_energy)[p] +
               points.data(points.plastic_work)[p];
  }



  template <int dim>
  void
  Outflow<dim>::list_quantities(const MPI_Comm communicator,
                                Quantities    &list) const
  {
    if (!is_open())
      return;
    list.push_back({"outflow points",
                    "",
                    1. * Utilities::MPI::sum(n_points_, communicator)});
    list.push_back(
      {"outflow mass", "kg", Utilities::MPI::sum(mass_, communicator)});
    append_vector<dim>(list,
                       "outflow momentum",
                       "kg m/s",
                       Utilities::MPI::sum(momentum_, communicator));
  }



  template <int dim>
  void
  Outflow<dim>::list_state(StateList &list)
  {
    if (!is_open())
      return;
    list.add("outflow points", "-", n_points_, Reduction::sum);
    list.add("outflow mass", "kg", mass_, Reduction::sum);
    list.add_components(
      "outflow momentum", "kg m/s", momentum_, dim, Reduction::sum);
    list.add("outflow energy", "J", energy_, Reduction::sum);
  }



  template class Outflow<2>;
  template class Outflow<3>;
} // namespace talus

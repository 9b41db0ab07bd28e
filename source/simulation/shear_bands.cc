// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/simulation/shear_bands.h>
#include <talus/simulation/yielded_extent.h>

#include <deal.II/base/mpi.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Sum of the plastic work of a body, J. Collective.
    template <int dim>
    double
    plastic_work(const State<dim> &state, const unsigned int body)
    {
      const Points<dim> &points = state.points;
      double             sum    = 0.;
      for (unsigned int p = 0; p < points.size(); ++p)
        if (points.data(points.body)[p] == body)
          sum += points.data(points.plastic_work)[p];
      return Utilities::MPI::sum(sum, state.communicator());
    }
  } // namespace



  template <int dim>
  bool
  ShearBands<dim>::is_enabled(const OutputSettings & /*settings*/) const
  {
    return !softening_bodies().empty();
  }



  template <int dim>
  std::vector<unsigned int>
  ShearBands<dim>::softening_bodies() const
  {
    std::vector<unsigned int> bodies;
    for (unsigned int b = 0; b < length_.size(); ++b)
      if (problem_.materials.of_body(b).softens())
        bodies.push_back(b);
    return bodies;
  }



  template <int dim>
  std::vector<std::string>
  ShearBands<dim>::columns(const OutputSettings & /*settings*/,
                           const State<dim> & /*state*/) const
  {
    const std::string name = dim == 2 ? "length" : "area";
    const std::string unit = dim == 2 ? "m" : "m^2";
    const auto        body = problem_.bodies().names();

    std::vector<std::string> result = {"time [s]"};
    for (const unsigned int b : softening_bodies())
      {
        result.push_back("yielded " + name + " of " + body[b] + " [" + unit +
                         "]");
        result.push_back("residual " + name + " of " + body[b] + " [" + unit +
                         "]");
        result.push_back("growth of the yielded " + name + " of " + body[b] +
                         " [" + unit + "/s]");
        result.push_back("plastic work of " + body[b] + " [J]");
      }
    return result;
  }



  // The first row has no row before, so no growth.
  template <int dim>
  void
  ShearBands<dim>::observe(const State<dim> &state)
  {
    const double        elapsed = state.time - time_;
    std::vector<double> row     = {state.time};
    for (const unsigned int b : softening_bodies())
      {
        const YieldedExtent extent = yielded_extent(state, problem_, b);
        const double        growth = extent.yielded - length_[b];
        row.insert(row.end(),
                   {extent.yielded,
                    extent.residual,
                    elapsed > 0. ? growth / elapsed : 0.,
                    plastic_work(state, b)});
        length_[b] = extent.yielded;
      }
    time_ = state.time;
    this->add_rows(state, {row});
  }



  // Checkpoints of runs without softening soil have nothing of this table.
  template <int dim>
  void
  ShearBands<dim>::list_state(StateList &list)
  {
    if (softening_bodies().empty())
      return;
    TableObserver<dim>::list_state(list);
    list.add("time of the last row of bands", "s", time_, Reduction::equal);
    list.add_components("yielded extent of body",
                        dim == 2 ? "m" : "m^2",
                        length_,
                        length_.size(),
                        Reduction::equal);
  }



  template class ShearBands<2>;
  template class ShearBands<3>;
} // namespace talus

#include <talus/observers/energy_budget.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    double
    kinetic_energy(const Points<dim> &points)
    {
      const double *mass   = points.data(points.mass);
      double        energy = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double *v = points.data(points.velocity, d);
          for (unsigned int p = 0; p < points.size(); ++p)
            energy += 0.5 * mass[p] * v[p] * v[p];
        }
      return energy;
    }



    template <int dim>
    double
    total(const Points<dim> &points, const unsigned int column)
    {
      const double *values = points.data(column);
      return std::accumulate(values, values + points.size(), 0.);
    }



    template <int dim>
    EnergyTerms
    sum_terms(const Snapshot<dim> &snapshot)
    {
      const Points<dim>    &points = snapshot.points;
      std::array<double, 8> sums   = {{kinetic_energy(points),
                                       snapshot.nodes.kinetic_energy(),
                                       total(points, points.elastic_energy),
                                       total(points, points.plastic_work),
                                       snapshot.boundary_work.friction,
                                       snapshot.boundary_work.contact,
                                       snapshot.boundary_work.damping,
                                       snapshot.gravity_work}};
      Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                          snapshot.grid.communicator(),
                          ArrayView<double>(sums.data(), sums.size()));
      return {sums[0],
              sums[1],
              sums[2],
              sums[3],
              sums[4],
              sums[5],
              sums[6],
              sums[7],
              0.};
    }
  } // namespace



  template <int dim>
  void
  EnergyBudget<dim>::begin(const Snapshot<dim> &snapshot)
  {
    start_ = sum_terms(snapshot);
  }



  template <int dim>
  EnergyTerms
  EnergyBudget<dim>::evaluate(const Snapshot<dim> &snapshot) const
  {
    EnergyTerms now = sum_terms(snapshot);
    now.remainder =
      (now.gravity - start_.gravity) - (now.kinetic - start_.kinetic) -
      (now.elastic - start_.elastic) - (now.plastic - start_.plastic) -
      (now.friction - start_.friction) - (now.contact - start_.contact) -
      (now.damping - start_.damping);
    return now;
  }



  template <int dim>
  void
  EnergyBudget<dim>::list_state(StateList &list)
  {
    const auto add = [&list](const std::string &name, double &value) {
      list.add(name + " at the start", "J", value, Reduction::equal);
    };
    add("kinetic energy", start_.kinetic);
    add("grid kinetic energy", start_.grid_kinetic);
    add("elastic energy", start_.elastic);
    add("plastic work", start_.plastic);
    add("friction work", start_.friction);
    add("contact work", start_.contact);
    add("damping work", start_.damping);
    add("gravity work", start_.gravity);
  }



  template class EnergyBudget<2>;
  template class EnergyBudget<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_well_balanced_load_h
#define talus_equilibrium_well_balanced_load_h

#include <talus/equilibrium/shape_function_cache.h>
#include <talus/equilibrium/static_contact.h>
#include <talus/equilibrium/static_problem.h>

#include <vector>

namespace talus
{
  /// Error of the weight in partly filled cells, computed from a reference
  /// stress in exact balance (doc/method.md, section 12).
  ///
  /// The reference stress is -p I with p = gamma' d, where d is the depth below
  /// the mudline and gamma' the mean submerged unit weight of all soil. The
  /// nodal forces of this stress, of its gradient and of its pressure on
  /// obstacles sum up to zero but for errors of quadrature, E. E is subtracted
  /// from the loads, so that soil without shear stress is in balance in cut
  /// cells, too. At nodes where p has no support, as at the free face of a
  /// cliff, E is not subtracted.
  template <int dim>
  class WellBalancedLoad
  {
  public:
    /// Compute E, unless points and nodes are as in the last call. E is empty
    /// without a mudline, without a weight along -y, or if the soil has moved
    /// away from its initial mudline. Collective.
    void
    update(const StaticProblem<dim>      &problem,
           const ShapeFunctionCache<dim> &weights,
           const StaticContact<dim>      &contact,
           Unknowns<dim>                 &unknowns);

    /// Error E at the nodes, dim components each, N; empty if there is none.
    /// Valid only at nodes owned by this rank.
    const std::vector<double> &
    forces() const
    {
      return forces_;
    }

    /// Number of nodes on all ranks at which E is not subtracted.
    unsigned long
    n_nodes_without() const
    {
      return n_nodes_without_;
    }

  private:
    bool
    is_current(const Points<dim> &points, const Unknowns<dim> &unknowns);
    void
    find_pressure(const StaticProblem<dim> &problem);
    bool
    has_moved(const StaticProblem<dim> &problem) const;
    double
    mean_unit_weight(const StaticProblem<dim> &problem) const;
    double
    mean_slope(const StaticProblem<dim> &problem,
               unsigned int              p,
               unsigned int              d,
               double                    height) const;
    void
    add_pressure_gradient(const ShapeFunctionCache<dim> &weights);
    void
    leave_walls_alone(const StaticProblem<dim> &problem,
                      const Unknowns<dim>      &unknowns);
    void
    leave_free_faces_alone(const StaticProblem<dim>      &problem,
                           const ShapeFunctionCache<dim> &weights,
                           Unknowns<dim>                 &unknowns);
    std::vector<double>
    largest_errors(const StaticProblem<dim>      &problem,
                   const ShapeFunctionCache<dim> &weights,
                   Unknowns<dim>                 &unknowns) const;

    double                              unit_weight_     = 0; ///< N/m^dim
    unsigned long                       n_nodes_without_ = 0;
    std::vector<double>                 forces_;
    std::vector<unsigned int>           nodes_;    ///< nodes with unknowns
    std::vector<dealii::Point<dim>>     place_;    ///< by point, m
    std::vector<double>                 volume_;   ///< by point, m^dim
    std::vector<double>                 pressure_; ///< by point, Pa
    std::vector<dealii::Tensor<1, dim>> gradient_; ///< pressure gradient, Pa/m
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_internal_forces_h
#define talus_equilibrium_internal_forces_h

#include <talus/equilibrium/shape_function_cache.h>
#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/stiffness_matrix.h>

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace talus
{
  /// Nodal forces of the stress at the end of a load step, and their
  /// derivative, as functions of the nodal displacements of the step.
  ///
  /// The B-bar method is the same as in the explicit scheme. The volume change
  /// of a point becomes theta_c, the mean over the points of the cell whose
  /// laws use B-bar; theta_c is linear in the displacements. The stress that
  /// does work on theta_c is averaged, too. Forces and matrix are the first and
  /// second derivative of the same work, so the matrix of elastic soil is
  /// symmetric. With volumes V and gradients of the start of the step, the
  /// stress P does the work V P : H on the displacement gradient H.
  template <int dim>
  class InternalForces
  {
  public:
    /// Compute the displacement gradients at the points from the nodal
    /// displacements @p u, m, with the mean of B-bar, and store them in the
    /// workspace.
    void
    set_gradients(StaticProblem<dim>            &problem,
                  const ShapeFunctionCache<dim> &weights,
                  const std::vector<double>     &u) const;

    /// Evaluate stresses and tangents of the points on this rank at the
    /// displacements @p u, m, and add the nodal forces, N, to @p forces.
    void
    evaluate(StaticProblem<dim>            &problem,
             const ShapeFunctionCache<dim> &weights,
             const std::vector<double>     &u,
             std::vector<double>           &forces);

    /// Add to @p forces, N, the nodal forces of the stress -p I, with the mean
    /// of B-bar. @p pressure holds p of each point on this rank, Pa. Overwrites
    /// the stresses of the last evaluate().
    void
    add_forces_of_pressure(const StaticProblem<dim>      &problem,
                           const ShapeFunctionCache<dim> &weights,
                           const std::vector<double>     &pressure,
                           std::vector<double>           &forces);

    /// Add the tangent of the last evaluate() to @p matrix.
    void
    add_tangent(const ShapeFunctionCache<dim> &weights,
                StiffnessMatrix<dim>          &matrix) const;

  private:
    static constexpr unsigned int n_gradients = dim * dim;

    struct Scratch
    {
      std::vector<dealii::Tensor<1, dim>> mean_gradient;
      std::vector<double>                 strain;   // B, by rows
      std::vector<double>                 stressed; // V A B
      dealii::FullMatrix<double>          matrix;
    };

    void
    find_volumes(const StaticProblem<dim> &problem);
    void
    add_forces_of_cell(unsigned int                   c,
                       const ShapeFunctionCache<dim> &weights,
                       std::vector<double>           &forces) const;
    void
    set_mean_gradient(unsigned int                   c,
                      const ShapeFunctionCache<dim> &weights,
                      Scratch                       &scratch) const;
    void
    fill_strain(const typename ShapeFunctionCache<dim>::Weight *weight,
                unsigned int                                    n_nodes,
                bool                                            uses_mean,
                Scratch                                        &scratch) const;
    void
    add_point(double                    volume,
              const StressTangent<dim> &linearization,
              unsigned int              n,
              Scratch                  &scratch) const;

    std::vector<StressTangent<dim>> linearizations_;
    std::vector<double>             volumes_; ///< at the start of the step
    std::vector<double> volumes_of_mean_;     ///< volumes_, 0 without B-bar
  };
} // namespace talus

#endif

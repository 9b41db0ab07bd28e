// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_internal_forces_h
#define talus_equilibrium_internal_forces_h

#include <talus/equilibrium/shape_function_cache.h>
#include <talus/equilibrium/static_problem.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <vector>

namespace talus
{
  /// Nodal forces of the stress at the end of a load step, as functions of the
  /// nodal displacements of the step, and their derivative.
  ///
  /// The B-bar is taken as in the dynamics: the volume change of a
  /// point becomes the mean over the points of its cell whose law asks for it,
  /// theta_c, which is linear in the
  /// displacements; what does work on that is the stress whose own mean is
  /// taken. Forces and matrix are the first and second derivative of the same
  /// work, so that an elastic matrix is symmetric.
  /// With volumes V of the start of the step and gradients there, the nominal
  /// stress P does the work V P : H on the displacement gradient H.
  template <int dim>
  class InternalForces
  {
  public:
    InternalForces(const StrainMeasure measure)
      : measure_(measure)
    {}

    /// Set the displacement gradients that the points hold, to those of the
    /// displacements @p u, m, after the mean, in the workspace.
    void
    set_gradients(StaticProblem<dim>            &problem,
                  const ShapeFunctionCache<dim> &weights,
                  const std::vector<double>     &u) const;

    /// Evaluate stresses and their derivatives, and add to @p forces, N, those
    /// of this rank's points. Returns false, with nothing added, if a point
    /// of this rank would be turned inside out.
    bool
    evaluate(StaticProblem<dim>            &problem,
             const ShapeFunctionCache<dim> &weights,
             const std::vector<double>     &u,
             std::vector<double>           &forces);

    /// Add to @p forces, N, those of the stress -p I, with the pressure p of each
    /// point of this rank in @p pressure, Pa, and the mean of B-bar. Overwrites
    /// the stresses of the last evaluate().
    void
    add_forces_of_pressure(const StaticProblem<dim>      &problem,
                           const ShapeFunctionCache<dim> &weights,
                           const std::vector<double>     &pressure,
                           std::vector<double>           &forces);

    /// Add the derivative found by the last evaluate() to @p matrix.
    void
    add_tangent(const ShapeFunctionCache<dim>          &weights,
                const Unknowns<dim>                    &unknowns,
                dealii::TrilinosWrappers::SparseMatrix &matrix) const;

  private:
    static constexpr unsigned int n_gradients = dim * dim;

    struct Scratch
    {
      std::vector<dealii::Tensor<1, dim>>          mean_gradient;
      std::vector<double>                          strain;   // B, row by row
      std::vector<double>                          stressed; // V A B
      dealii::FullMatrix<double>                   matrix;
      std::vector<dealii::types::global_dof_index> unknowns;
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

    StrainMeasure                   measure_;
    std::vector<StressTangent<dim>> linearizations_;
    std::vector<double>             volumes_; ///< at the start of the step
    std::vector<double> volumes_of_mean_; ///< the same, 0 where none is taken
  };
} // namespace talus

#endif

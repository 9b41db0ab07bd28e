#ifndef talus_materials_load_step_h
#define talus_materials_load_step_h

#include <talus/base/dual.h>
#include <talus/materials/hyperelastic_kernel.h>
#include <talus/materials/material_model.h>
#include <talus/materials/radial_return_kernel.h>

// One step of a quasi-static load with the same formulas as one of the
// dynamics, and their derivative: what a law says to the search for equilibrium.

namespace talus
{
  /// Displacement gradient H of the step with its derivatives by itself, at the
  /// point @p p.
  template <int dim>
  inline Matrix<dim, Dual<dim * dim>>
  load_independent_gradient(const WorkspaceView<dim> &workspace,
                            const unsigned int        p)
  {
    const auto H = load_velocity_gradient<dim, double>(workspace, p);
    Matrix<dim, Dual<dim * dim>> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          result[i][j]                         = H[i][j];
          result[i][j].derivative[dim * i + j] = 1.;
        }
    return result;
  }



  template <int dim, typename Number>
  inline Matrix<dim, Number>
  identity_plus(Matrix<dim, Number> A)
  {
    for (unsigned int i = 0; i < dim; ++i)
      A[i][i] += 1.;
    return A;
  }



  /// Strain of a step whose displacement is infinitesimal.
  template <int dim, typename Number>
  inline StrainIncrement<dim, Number>
  small_strain_increment(const Matrix<dim, Number> &H)
  {
    StrainIncrement<dim, Number> strain;
    strain.volumetric = trace(H);
    Stress<dim, Number> D{};
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        D[stress_index<dim>(i, j)] = 0.5 * (H[i][j] + H[j][i]);
    strain.deviatoric    = add_mean(D, Number(strain.volumetric * (-1. / 3.)));
    strain.half_rotation = half_rotation(Matrix<dim, Number>{});
    return strain;
  }



  template <int dim, typename Number>
  inline StrainIncrement<dim, Number>
  strain_of_load_step(const Matrix<dim, Number> &H, const StrainMeasure measure)
  {
    if (measure == StrainMeasure::small)
      return small_strain_increment(H);
    Motion<dim, Number> motion;
    motion.increment  = H;
    motion.dilatation = determinant_increment(H);
    return strain_increment(motion);
  }



  /// Write a stress and its derivative to @p answer as those of the first
  /// Piola-Kirchhoff stress seen from the start of the step: @p kirchhoff is
  /// det(I + H) times the Cauchy stress.
  template <int dim>
  inline void
  store_nominal(const Stress<dim, Dual<dim * dim>> &kirchhoff,
                const Matrix<dim, Dual<dim * dim>> &H,
                const StrainMeasure                 measure,
                StressTangent<dim>                 &answer)
  {
    using Number = Dual<dim * dim>;
    const auto inverse_f =
      (measure == StrainMeasure::large ? inverse(identity_plus(H))
                                       : identity<dim, Number>());
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          Number P;
          for (unsigned int k = 0; k < dim; ++k)
            P += kirchhoff[stress_index<dim>(std::min(i, k), std::max(i, k))] *
                 inverse_f[j][k];
          answer.stress[dim * i + j]  = P.value;
          answer.tangent[dim * i + j] = P.derivative;
        }
  }



  /// What plastic flow does to the trial deviator.
  template <typename Number>
  struct Flow
  {
    Number removed;   ///< share of the deviator that goes
    Number increment; ///< of the law's plastic variable
  };



  /// MaterialModel::linearize() for laws in rate form: @p flow maps a point and
  /// its trial deviator to a Flow. Returns false if a point is turned inside
  /// out.
  template <int dim, typename FlowRule>
  inline bool
  linearize_rate_law(const Points<dim>        &points,
                     const StepWorkspace<dim> &workspace,
                     const unsigned int        begin,
                     const unsigned int        end,
                     const StrainMeasure       measure,
                     const Moduli             &moduli,
                     StressTangent<dim>       *answer,
                     const FlowRule           &flow)
  {
    using Number    = Dual<dim * dim>;
    const auto work = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p)
      {
        const auto   H          = load_independent_gradient(work, p);
        const Number dilatation = determinant_increment(H);
        if (measure == StrainMeasure::large && !(dilatation.value > -1.))
          return false;
        const auto          strain = strain_of_load_step(H, measure);
        const auto          before = load_stress<dim, double>(points, p);
        Stress<dim, Number> sigma;
        std::copy(before.begin(), before.end(), sigma.begin());

        const auto   trial    = elastic_trial<dim>(sigma, strain, moduli);
        const Number removed  = flow(p, trial.deviator_after).removed;
        auto         deviator = trial.deviator_after;
        for (Number &component : deviator)
          component *= 1. - removed;
        sigma =
          add_mean(turn(strain.half_rotation, deviator), trial.mean_after);
        if (measure == StrainMeasure::large)
          for (Number &component : sigma)
            component *= 1. + dilatation;
        store_nominal(sigma, H, measure, answer[p - begin]);
      }
    return true;
  }



  /// MaterialModel::accept() for laws in rate form. @p plastic is the column of
  /// the plastic variable, or invalid_unsigned_int.
  template <int dim, typename FlowRule>
  inline void
  accept_rate_law(Points<dim>              &points,
                  const StepWorkspace<dim> &workspace,
                  const unsigned int        begin,
                  const unsigned int        end,
                  const StrainMeasure       measure,
                  const Moduli             &moduli,
                  const unsigned int        plastic,
                  const FlowRule           &flow)
  {
    const auto columns = points.view();
    const auto work    = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p)
      {
        Motion<dim, double> motion;
        if (measure == StrainMeasure::large)
          motion = advance_deformation<dim, double>(columns, work, p, 1.);
        else
          {
            motion.increment = load_velocity_gradient<dim, double>(work, p);
            motion.J_before = motion.J_after = determinant(
              load_matrix<dim, double>(points, points.deformation_gradient, p));
          }
        const auto strain = strain_of_load_step(motion.increment, measure);
        const auto trial =
          elastic_trial<dim, double>(load_stress<dim, double>(points, p),
                                     strain,
                                     moduli);
        const Flow<double> plastic_flow = flow(p, trial.deviator_after);
        if (plastic != dealii::numbers::invalid_unsigned_int)
          points.data(plastic)[p] += plastic_flow.increment;
        return_radially<dim, double>(
          columns, p, motion, strain, trial, moduli.mu, plastic_flow.removed);
      }
  }



  /// MaterialModel::linearize() for hyperelastic laws; @p response as in
  /// update_by_state().
  template <int dim, typename Response>
  inline bool
  linearize_by_state(const Points<dim>        &points,
                     const StepWorkspace<dim> &workspace,
                     const unsigned int        begin,
                     const unsigned int        end,
                     StressTangent<dim>       *answer,
                     const Response           &response)
  {
    using Number    = Dual<dim * dim>;
    const auto work = workspace.view(begin, end);
    for (unsigned int p = begin; p < end; ++p)
      {
        const auto H = load_independent_gradient(work, p);
        if (!(determinant_increment(H).value > -1.))
          return false;
        const auto before =
          load_matrix<dim, double>(points, points.deformation_gradient, p);
        Matrix<dim, Number> F;
        for (unsigned int i = 0; i < dim; ++i)
          std::copy(before[i].begin(), before[i].end(), F[i].begin());
        F = product(identity_plus(H), F);

        StateResponse<dim, Number> after = response(deformation_state(F));
        for (Number &component : after.kirchhoff)
          component *= 1. / determinant(before);
        store_nominal(after.kirchhoff,
                      H,
                      StrainMeasure::large,
                      answer[p - begin]);
      }
    return true;
  }
} // namespace talus

#endif

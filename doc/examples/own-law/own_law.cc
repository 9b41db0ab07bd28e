// A constitutive law of one's own: the program, with one law more.
#include <talus/application/program.h>
#include <talus/materials/factory.h>
#include <talus/materials/hyperelastic_law.templates.h>

using namespace talus;

// W = lambda/2 (J - 1)^2 + mu/2 (tr(F F^T) - 3 - 2 ln J), for one point or
// many.
struct Energy
{
  Moduli moduli;

  template <int dim, typename Number>
  StateResponse<dim, Number>
  response(const DeformationState<dim, Number> &state) const
  {
    const Number J      = 1. + state.J_minus_1;
    auto         stress = state.b_minus_1;
    Number       square{};
    for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
      stress[c] *= moduli.mu;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        square += state.A[i][j] * state.A[i][j];
    return {add_mean(stress, Number(moduli.lambda * J * state.J_minus_1)),
            0.5 * moduli.lambda * state.J_minus_1 * state.J_minus_1 +
              moduli.mu * (trace(state.A) - state.log_J + 0.5 * square)};
  }

  template <int dim, typename Number>
  Number
  largest_modulus(const DeformationState<dim, Number> &state) const
  {
    const EigenvalueRange<dim, Number> b(state.b_minus_1);
    const Number                       J = 1. + state.J_minus_1;
    return moduli.lambda * J * J + moduli.mu * (2. + b.mean + b.distance);
  }
};

template <int dim>
class OwnLaw : public HyperelasticLaw<dim, Energy>
{
  using HyperelasticLaw<dim, Energy>::HyperelasticLaw;

  Energy
  strain_energy() const override
  {
    return {this->moduli()};
  }
};

int
main(int argc, char **argv)
{
  add_law<OwnLaw>("own law");
  return run_program(argc, argv);
}

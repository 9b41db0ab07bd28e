#include <talus/materials/hencky.h>
#include <talus/materials/hyperelastic.h>

#include <deal.II/base/symmetric_tensor.h>

namespace talus
{
  namespace
  {
    /// ln V, the logarithmic strain.
    ///
    /// In the plane b = m I + dev b has the eigenvalues m +- r, r = |dev b|, so
    /// ln V = (ln b)/2 = (ln J)/2 I + artanh(r/m)/(2 r) dev b. With
    /// y = 2r/(m-r) = 2r (m+r)/J^2 the factor is ln(1+y)/y (m+r)/(2 J^2): well
    /// behaved for equal eigenvalues and for any stretch.
    template <typename Number>
    inline Stress<2, Number>
    logarithmic_strain(const DeformationState<2, Number> &state)
    {
      const auto                      &b = state.b_minus_1;
      const EigenvalueRange<2, Number> range(b);
      const Number m = 1. + range.mean, J = 1. + state.J_minus_1;
      const Number r      = max(range.distance, broadcast<Number>(1e-100));
      const Number y      = 2. * r * (m + r) / (J * J);
      const Number factor = 0.5 * logarithm_1p(y) / y * (m + r) / (J * J);

      const Number mean = 0.5 * state.log_J;
      const Number d    = factor * 0.5 * (b[0] - b[1]);
      return {{mean + d, mean - d, Number{}, factor * b[3]}};
    }



    /// In space by the principal directions of b.
    inline Stress<3, double>
    logarithmic_strain(const DeformationState<3, double> &state)
    {
      using dealii::SymmetricTensor;
      SymmetricTensor<2, 3> b;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          b[i][j] = state.b_minus_1[stress_index<3>(i, j)];
      const auto principal =
        eigenvectors(b, dealii::SymmetricTensorEigenvectorMethod::jacobi);

      Stress<3, double> strain{};
      for (const auto &[value, n] : principal)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = i; j < 3; ++j)
            strain[stress_index<3>(i, j)] +=
              0.5 * std::log1p(value) * n[i] * n[j];
      return strain;
    }



    inline Stress<3, Lanes>
    logarithmic_strain(const DeformationState<3, Lanes> &state)
    {
      Stress<3, Lanes> strain;
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        {
          DeformationState<3, double> one;
          for (unsigned int c = 0; c < 6; ++c)
            one.b_minus_1[c] = state.b_minus_1[c][lane];
          const auto one_strain = logarithmic_strain(one);
          for (unsigned int c = 0; c < 6; ++c)
            strain[c][lane] = one_strain[c];
        }
      return strain;
    }



    template <int dim, typename Number>
    inline StateResponse<dim, Number>
    hencky(const DeformationState<dim, Number> &state, const Moduli &moduli)
    {
      const auto deviator =
        add_mean(logarithmic_strain(state), Number(-state.log_J * (1. / 3.)));
      const Number mean = moduli.bulk * state.log_J;

      StateResponse<dim, Number> answer;
      for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
        answer.kirchhoff[c] = 2. * moduli.mu * deviator[c];
      answer.kirchhoff = add_mean(answer.kirchhoff, mean);
      answer.energy    = 0.5 * mean * state.log_J +
                      moduli.mu * contract<dim>(deviator, deviator);
      return answer;
    }



    /// J times an upper bound of the acoustic tensor's eigenvalues, which is
    /// lambda + 2 mu in the undeformed state. For direction n and polarisation
    /// a, with tau = tau_min I + tau', the spatial tangent and the stress give
    ///   (lambda + mu - tau_min) (n.a)^2 + mu + n.tau'.n
    /// at most, where tau_min = lambda ln J + 2 mu ln l_min and
    /// n.tau'.n <= 2 mu ln(l_max/l_min). In 2-D waves run in the plane and see
    /// the stretches l in the plane only.
    template <int dim, typename Number>
    inline Number
    largest_modulus(const DeformationState<dim, Number> &state,
                    const Moduli                        &moduli)
    {
      const EigenvalueRange<dim, Number> strain(logarithmic_strain(state));
      const Number log_l_max = strain.mean + strain.distance;
      const Number log_l_min = strain.mean - strain.distance;
      const Number longitudinal =
        moduli.lambda * (1. - state.log_J) + moduli.mu * (1. - 2. * log_l_min);
      return max(longitudinal, Number{}) +
             moduli.mu * (1. + 2. * (log_l_max - log_l_min));
    }
  } // namespace



  template <int dim>
  Hencky<dim>::Hencky(const std::string &section)
    : MaterialModel<dim>(section)
  {
    elasticity_.declare(*this);
  }



  template <int dim>
  void
  Hencky<dim>::check() const
  {
    MaterialModel<dim>::check();
    elasticity_.check(this->section());
  }



  template <int dim>
  void
  Hencky<dim>::update_stress(Points<dim>       &points,
                             const unsigned int begin,
                             const unsigned int end,
                             const double       dt) const
  {
    update_by_state(points,
                    begin,
                    end,
                    dt,
                    [moduli = elasticity_.moduli()](const auto &state) {
                      return hencky(state, moduli);
                    });
  }



  template <int dim>
  void
  Hencky<dim>::wave_speed(const Points<dim> &points,
                          const unsigned int begin,
                          const unsigned int end,
                          double            *speed) const
  {
    wave_speed_by_state(points,
                        begin,
                        end,
                        speed,
                        [moduli = elasticity_.moduli()](const auto &state) {
                          return largest_modulus(state, moduli);
                        });
  }



  template class Hencky<2>;
  template class Hencky<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/problem/random_field.h>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_01.hpp>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // The correlation of a single realization differs from the kernel by about
    // 1/sqrt(n_waves).
    constexpr unsigned int n_waves = 2000;
  } // namespace



  // The spectral density of the Matern correlation of smoothness nu is a
  // multivariate t distribution with 2 nu degrees of freedom: a normal vector
  // over the root of a mean of 2 nu squares of normal numbers
  // (@cite rasmussen2006, eq. 4.15). Boost's distributions, other than those of
  // the standard library, are the same with every compiler.
  template <int dim>
  RandomField<dim>::RandomField(const StrengthVariation &variation)
    : deviation_(std::sqrt(
        std::log1p(variation.coefficient() * variation.coefficient())))
  {
    boost::random::mt19937                     generator(variation.seed());
    boost::random::normal_distribution<double> normal;
    boost::random::uniform_01<double>          uniform;
    const unsigned int                         n = variation.twice_smoothness();
    for (unsigned int w = 0; w < n_waves; ++w)
      {
        Wave   wave;
        double squares = 0.;
        for (unsigned int i = 0; i < n; ++i)
          squares += std::pow(normal(generator), 2);
        for (unsigned int d = 0; d < dim; ++d)
          wave.vector[d] = normal(generator) / std::sqrt(squares / n) /
                           variation.correlation_length(d);
        wave.phase = 2. * numbers::PI * uniform(generator);
        waves_.push_back(wave);
      }
  }



  template <int dim>
  double
  RandomField<dim>::operator()(const Point<dim> &x) const
  {
    double sum = 0.;
    for (const Wave &wave : waves_)
      sum += std::cos(wave.vector * x + wave.phase);
    const double standard_normal = std::sqrt(2. / n_waves) * sum;
    return std::exp(deviation_ * (standard_normal - 0.5 * deviation_));
  }



  template class RandomField<2>;
  template class RandomField<3>;
} // namespace talus

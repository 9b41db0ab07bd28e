// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_random_field_h
#define talus_problem_random_field_h

#include <talus/materials/strength_variation.h>

#include <deal.II/base/point.h>

#include <vector>

namespace talus
{
  /// A realization of a lognormal random field of mean 1: a function of the
  /// place, independent of mesh, ranks and the order of evaluation. The
  /// logarithm is a sum of cosines with random wave vectors and phases
  /// (spectral representation, @cite shinozuka1991).
  template <int dim>
  class RandomField
  {
  public:
    explicit RandomField(const StrengthVariation &variation);

    /// Return the value at @p x, m [-].
    double
    operator()(const dealii::Point<dim> &x) const;

  private:
    struct Wave
    {
      dealii::Tensor<1, dim> vector; ///< 1/m
      double                 phase;  ///< rad
    };

    double            deviation_; ///< standard deviation of the logarithm [-]
    std::vector<Wave> waves_;
  };
} // namespace talus

#endif

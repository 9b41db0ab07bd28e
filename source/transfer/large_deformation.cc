// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/points/points_kernel.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/large_deformation.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    // Norm of F beyond which F is shortened, and new length of the longest
    // axis. At 1000 the volume still has ten digits.
    constexpr double max_norm = 1e3, new_length = 500.;



    template <int dim, typename Number>
    TALUS_ALWAYS_INLINE Number
    norm_square_of_F(const PointsView<dim> &points, const unsigned int p)
    {
      const auto F =
        load_matrix<dim, Number>(points, points.deformation_gradient, p);
      Number square{};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          square += F[i][j] * F[i][j];
      return square;
    }



    /// Return M F, see renew_large_deformations().
    template <int dim>
    Tensor<2, dim>
    shortened(const Tensor<2, dim> &F)
    {
      // Eigenvalues in descending order.
      const auto     modes    = eigenvectors(symmetrize(F * transpose(F)),
                                      SymmetricTensorEigenvectorMethod::jacobi);
      const auto    &longest  = modes.front().second;
      const auto    &shortest = modes.back().second;
      const double   factor   = new_length / std::sqrt(modes.front().first);
      Tensor<2, dim> M        = unit_symmetric_tensor<dim>();
      M += (factor - 1.) * outer_product(longest, longest) +
           (1. / factor - 1.) * outer_product(shortest, shortest);
      return M * F;
    }



    /// Return the stretch of point @p p computed from its current F.
    template <int dim>
    Tensor<1, dim>
    stretch_by_F(Points<dim> &points, const unsigned int p, const BoxRule rule)
    {
      initialize_stretch(points, p, p + 1, rule);
      return load_vector(points, points.stretch, p);
    }



    template <int dim>
    void
    renew(Points<dim> &points, const unsigned int p, const BoxRule rule)
    {
      const auto     F_column = points.deformation_gradient;
      Tensor<2, dim> F;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          F[i][j] = points.data(F_column, dim * i + j)[p];
      const Tensor<2, dim> new_F = shortened(F);
      const auto           store = [&]() {
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            points.data(F_column, dim * i + j)[p] = new_F[i][j];
      };
      // The stretch of fixed boxes does not depend on F.
      if (rule == BoxRule::fixed)
        {
          store();
          return;
        }
      const auto at_creation = load_vector(points, points.creation_stretch, p);
      const auto before      = stretch_by_F(points, p, rule);
      store();
      const auto after = stretch_by_F(points, p, rule);
      for (unsigned int d = 0; d < dim; ++d)
        {
          points.data(points.reference_length, d)[p] *= before[d] / after[d];
          points.data(points.creation_stretch, d)[p] =
            at_creation[d] * (after[d] / before[d]);
        }
    }
  } // namespace



  // Most calls only test F, in a fast pass over data in the cache.
  template <int dim>
  void
  renew_large_deformations(Points<dim>       &points,
                           const unsigned int begin,
                           const unsigned int end,
                           const BoxRule      rule)
  {
    const auto columns   = points.view();
    bool       has_large = false;
    for_each_simd(begin,
                  end,
                  [&](const unsigned int p, auto number) TALUS_INLINE_LAMBDA {
                    using Number = decltype(number);
                    has_large |= any(norm_square_of_F<dim, Number>(columns, p) >
                                     Number(max_norm * max_norm));
                  });
    if (has_large)
      for (unsigned int p = begin; p < end; ++p)
        if (norm_square_of_F<dim, double>(columns, p) > max_norm * max_norm)
          renew(points, p, rule);
  }



  template decltype(renew_large_deformations<2>) renew_large_deformations<2>;
  template decltype(renew_large_deformations<3>) renew_large_deformations<3>;
} // namespace talus

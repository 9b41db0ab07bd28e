// SPDX-License-Identifier: LGPL-2.1-or-later
// Lognormal random field of the strength: moments and correlation.

#include <talus/base/errors.h>
#include <talus/problem/strength_field.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>
#include <vector>

using namespace talus;
using dealii::Point;

namespace
{
  /// Section that holds the parameters of a random field.
  struct Section : dealii::ParameterAcceptor
  {
    Section()
      : dealii::ParameterAcceptor("Clay")
    {
      variation.add_parameters(*this);
    }
    StrengthVariation variation;
  };



  StrengthVariation
  variation(const std::string &entries)
  {
    dealii::ParameterAcceptor::clear();
    dealii::ParameterAcceptor::prm.clear();
    Section            section;
    std::istringstream file("subsection Clay\nsubsection Strength field\n" +
                            entries + "\nend\nend\n");
    dealii::ParameterAcceptor::initialize(file);
    return section.variation;
  }



  StrengthVariation
  variation(const unsigned int seed, const std::string &entries)
  {
    return variation(entries + "\nset Seed = " + std::to_string(seed));
  }



  constexpr unsigned int n_seeds = 200, n_places = 20;

  /// Means of functions of a field and a place, over seeds and over places that
  /// are a hundred correlation lengths apart.
  template <int dim>
  std::vector<double>
  means(const std::string                                            &entries,
        const std::function<std::vector<double>(const RandomField<dim> &,
                                                const Point<dim> &)> &f)
  {
    std::vector<double> result;
    for (unsigned int seed = 1; seed <= n_seeds; ++seed)
      {
        const RandomField<dim> field(variation(seed, entries));
        for (unsigned int i = 0; i < n_places; ++i)
          {
            Point<dim> x;
            x[0]              = 2000. * i;
            const auto values = f(field, x);
            result.resize(values.size());
            for (unsigned int k = 0; k < values.size(); ++k)
              result[k] += values[k] / (n_seeds * n_places);
          }
      }
    return result;
  }

  // Standard deviation of a mean of independent numbers of deviation 1. The
  // product of two standard normal numbers has a deviation of at most sqrt(2).
  const double deviation_of_mean = 1. / std::sqrt(1. * n_seeds * n_places);
} // namespace



TEST(RandomField, MeanAndVariation)
{
  const double cov = 0.3;
  const auto   found =
    means<2>("set Coefficient of variation = 0.3\n"
             "set Correlation lengths = 20, 2",
             [](const auto &field, const auto &x) {
               const double value = field(x);
               return std::vector<double>{value, std::pow(value - 1., 2)};
             });
  EXPECT_NEAR(found[0], 1., 4. * cov * deviation_of_mean);
  EXPECT_NEAR(std::sqrt(found[1]), cov, 4. * cov * deviation_of_mean);
}



// The logarithm is normal: its standard deviation is sqrt(ln(1 + cov^2)), and
// the correlation at 0.5, 1 and 2 lengths along each axis is the kernel.
template <int dim>
void
expect_correlation(const std::string                   &kernel,
                   const std::function<double(double)> &correlation)
{
  const double deviation = std::sqrt(std::log1p(0.04));
  const double length[] = {20., 2., 5.}, distances[] = {0.5, 1., 2.};
  const auto normal = [&](const RandomField<dim> &field, const Point<dim> &x) {
    return std::log(field(x)) / deviation + 0.5 * deviation;
  };
  const auto found =
    means<dim>("set Coefficient of variation = 0.2\nset Kernel = " + kernel +
                 "\nset Correlation lengths = 20, 2" + (dim == 3 ? ", 5" : ""),
               [&](const auto &field, const auto &x) {
                 const double        at_x = normal(field, x);
                 std::vector<double> products;
                 for (unsigned int d = 0; d < dim; ++d)
                   for (const double r : distances)
                     {
                       Point<dim> y = x;
                       y[d] += r * length[d];
                       products.push_back(at_x * normal(field, y));
                     }
                 return products;
               });
  for (unsigned int k = 0; k < found.size(); ++k)
    EXPECT_NEAR(found[k],
                correlation(distances[k % 3]),
                4. * std::sqrt(2.) * deviation_of_mean)
      << kernel << " along " << k / 3 << " at " << distances[k % 3];
}



TEST(RandomField, CorrelationIsTheKernel)
{
  expect_correlation<2>("exponential", [](double r) { return std::exp(-r); });
  expect_correlation<2>("Matern 3/2", [](double r) {
    const double a = std::sqrt(3.) * r;
    return (1. + a) * std::exp(-a);
  });
  expect_correlation<3>("Matern 5/2", [](double r) {
    const double a = std::sqrt(5.) * r;
    return (1. + a + a * a / 3.) * std::exp(-a);
  });
}



TEST(RandomField, InfiniteLengthIsOneLognormalFactor)
{
  const std::string entries   = "set Coefficient of variation = 0.5\n"
                                "set Correlation lengths = 1e30";
  const double      deviation = std::sqrt(std::log1p(0.25));
  double            sum = 0., squares = 0.;
  for (unsigned int seed = 1; seed <= n_seeds; ++seed)
    {
      const RandomField<2> field(variation(seed, entries));
      const double         factor = field(Point<2>(0., 0.));
      EXPECT_DOUBLE_EQ(field(Point<2>(-3e4, 500.)), factor);
      const double z = std::log(factor) / deviation + 0.5 * deviation;
      sum += z / n_seeds;
      squares += z * z / n_seeds;
    }
  EXPECT_NEAR(sum, 0., 4. / std::sqrt(1. * n_seeds));
  EXPECT_NEAR(squares, 1., 4. * std::sqrt(2. / n_seeds));
}



// One seed is one field; lengths are needed, one or one for each axis.
TEST(RandomField, SeedsAndLengths)
{
  const std::string entries = "set Coefficient of variation = 0.2\n"
                              "set Correlation lengths = ";
  const Point<2>    x(3., 4.);
  EXPECT_EQ(RandomField<2>(variation(7, entries + "5"))(x),
            RandomField<2>(variation(7, entries + "5, 5"))(x));
  EXPECT_NE(RandomField<2>(variation(8, entries + "5"))(x),
            RandomField<2>(variation(7, entries + "5"))(x));
  for (const std::string lengths : {"", "1, 2, 3"})
    EXPECT_THROW(variation(entries + lengths).check(2, "Clay"), ExcUser);
  EXPECT_NO_THROW(variation(entries + "1, 2, 3").check(3, "Clay"));
}

#ifndef talus_materials_elastic_wave_speed_h
#define talus_materials_elastic_wave_speed_h

#include <talus/materials/elasticity.h>
#include <talus/points/points.h>
#include <talus/points/points_kernel.h>

namespace talus
{
  /// sqrt((lambda + 2 mu)/rho) with the current density.
  template <int dim>
  TALUS_ALWAYS_INLINE void
  elastic_wave_speed(const Points<dim> &points,
                     const unsigned int begin,
                     const unsigned int end,
                     const Moduli      &moduli,
                     double            *speed)
  {
    const double modulus = moduli.lambda + 2. * moduli.mu;
    const auto   columns = points.view();
    for_each_simd(begin, end, [&](const unsigned int p, auto number) {
      using Number = decltype(number);
      store(speed + (p - begin),
            sqrt(modulus * volume_of_points<dim, Number>(columns, p) /
                 load<Number>(columns.data(columns.mass) + p)));
    });
  }
} // namespace talus

#endif

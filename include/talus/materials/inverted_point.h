// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_inverted_point_h
#define talus_materials_inverted_point_h

#include <talus/points/points.h>

namespace talus
{
  /// Throw ExcPoint for the first point of [@p begin, @p end) whose deformation
  /// gradient does not have a positive determinant, if any. The message names
  /// the likely cause first: stiffness in a wrong unit if @p shear_modulus, Pa,
  /// is less than the weight per area of the soil above the point, with the
  /// submerged @p density, kg/m^3; otherwise too long time steps.
  template <int dim>
  void
  throw_inverted_point(const Points<dim> &points,
                       unsigned int       begin,
                       unsigned int       end,
                       double             shear_modulus,
                       double             density);



  /// Throw ExcPoint for the first point of [@p begin, @p end) whose plastic
  /// variable, in column @p plastic, was not found, if any.
  template <int dim>
  void
  throw_unsolved_point(const Points<dim> &points,
                       unsigned int       begin,
                       unsigned int       end,
                       unsigned int       plastic);
} // namespace talus

#endif

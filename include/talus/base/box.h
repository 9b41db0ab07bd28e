// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_box_h
#define talus_base_box_h

#include <deal.II/base/point.h>

namespace talus
{
  /// Axis-aligned box, coordinates in m.
  template <int dim>
  struct Box
  {
    dealii::Point<dim> lower;
    dealii::Point<dim> upper;

    bool
    contains(const dealii::Point<dim> &x) const
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!(x[d] >= lower[d] && x[d] <= upper[d]))
          return false;
      return true;
    }

    double
    length(const unsigned int d) const
    {
      return upper[d] - lower[d];
    }
  };
} // namespace talus

#endif

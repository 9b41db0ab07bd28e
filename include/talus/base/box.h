// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_box_h
#define talus_base_box_h

#include <deal.II/base/point.h>

#include <algorithm>
#include <vector>

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



  /// Return the smallest box that contains all of @p places, at least one.
  template <int dim>
  Box<dim>
  bounding_box(const std::vector<dealii::Point<dim>> &places)
  {
    Box<dim> box{places[0], places[0]};
    for (const auto &x : places)
      for (unsigned int d = 0; d < dim; ++d)
        {
          box.lower[d] = std::min(box.lower[d], x[d]);
          box.upper[d] = std::max(box.upper[d], x[d]);
        }
    return box;
  }
} // namespace talus

#endif

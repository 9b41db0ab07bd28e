// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_box_extent_h
#define talus_contact_box_extent_h

#include <talus/points/points.h>

#include <cmath>

namespace talus
{
  /// Return the half lengths of the box of point @p p, m, without the clipping
  /// used for weights. For a convected domain: the half lengths of its
  /// axis-parallel bounding box.
  template <int dim>
  dealii::Tensor<1, dim>
  half_lengths_of_box(const Points<dim> &points, const unsigned int p)
  {
    return 0.5 * load_vector(points, points.box_length, p);
  }



  /// Return the distance, m, between the centre of a box and a plane with unit
  /// normal @p normal which touches the box. @p half: half lengths of the box,
  /// m.
  template <int dim>
  double
  support_of_box(const dealii::Tensor<1, dim> &half,
                 const dealii::Tensor<1, dim> &normal)
  {
    double result = 0;
    for (unsigned int d = 0; d < dim; ++d)
      result += half[d] * std::abs(normal[d]);
    return result;
  }



  /// Maximum distance, in cells, between a surface and the lower side of a box
  /// by which the box still covers the surface. Boxes parallel to the axes
  /// leave gaps over a surface inclined to the axes.
  constexpr double largest_gap_of_covering_box = 0.25;
} // namespace talus

#endif

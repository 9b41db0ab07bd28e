// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_joint_box_h
#define talus_adaptivity_joint_box_h

#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

#include <array>

namespace talus
{
  /// Box of the point into which two points p and q are merged.
  ///
  /// The joint box has the second moments of mass of the two boxes together,
  ///   l_d^2 = w_p l_pd^2 + w_q l_qd^2 + 12 w_p w_q (x_q - x_p)_d^2,
  /// with the mass fractions w. If the union of the two boxes is a box, the
  /// result is the union. A common factor on all lengths then gives the sum of
  /// both volumes; it measures how far the union is from a box. Lengths of
  /// convected domains are measured along the edges.
  template <int dim>
  class JointBox
  {
  public:
    /// Join the boxes of points @p p and @p q, which follow @p rule.
    JointBox(const Points<dim> &points,
             BoxRule            rule,
             unsigned int       p,
             unsigned int       q);

    /// Axis along which the two points lie side by side.
    unsigned int
    axis() const
    {
      return axis_;
    }

    /// Length of the joint box along axis @p d, m.
    double
    length(const unsigned int d) const
    {
      return length_[d];
    }

    /// Relative error of the volume by second moments against the sum of both
    /// volumes, absolute value [-]. Zero if the union of the boxes is a box;
    /// larger if the boxes overlap, leave a gap or are shifted against each
    /// other.
    double
    misfit() const
    {
      return misfit_;
    }

    /// Mass of point p over the mass of both points [-].
    double
    mass_share() const
    {
      return mass_share_;
    }

  private:
    unsigned int            axis_   = 0;
    std::array<double, dim> length_ = {};
    double                  misfit_ = 0;
    double                  mass_share_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_joint_box_h
#define talus_adaptivity_joint_box_h

#include <talus/points/points.h>
#include <talus/transfer/box_shape.h>

#include <array>

namespace talus
{
  /// The box of two points as one.
  ///
  /// The box has the second moments of mass of the two boxes together,
  ///   l_d^2 = w_p l_pd^2 + w_q l_qd^2 + 12 w_p w_q (x_q - x_p)_d^2,
  /// with the shares w of the mass: of two boxes that make a box that is the
  /// union, exactly. Its volume is that of both boxes; how much it had to be
  /// scaled for that says how far their union is from a box. Lengths of a
  /// convected domain are those of its edges.
  template <int dim>
  class JointBox
  {
  public:
    JointBox(const Points<dim> &points,
             BoxRule            rule,
             unsigned int       p,
             unsigned int       q);

    /// The axis along which the points lie side by side.
    unsigned int
    axis() const
    {
      return axis_;
    }

    /// Length along axis d, m.
    double
    length(const unsigned int d) const
    {
      return length_[d];
    }

    /// Volume of the box by second moments over that of both boxes, less 1,
    /// absolute value [-]; 0 if their union is a box. More than that where they
    /// overlap, leave a gap or are shifted against one another.
    double
    misfit() const
    {
      return misfit_;
    }

    /// Share of point @p p in the mass [-]; that of the other one is the rest.
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

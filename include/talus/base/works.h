// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_works_h
#define talus_base_works_h

#include <talus/base/state.h>

#include <deal.II/base/tensor.h>

namespace talus
{
  /// Work and impulse of loads, boundaries and damping on the soil, in one step
  /// or in all steps.
  template <int dim>
  struct Works
  {
    /// Work of weight and body forces on the soil, J.
    double gravity = 0;
    /// Energy dissipated by friction, J.
    double friction = 0;
    /// Energy taken from the soil by normal contact, walls and tractions, J;
    /// negative if they drive the soil.
    double contact = 0;
    /// Energy dissipated by local damping, J.
    double damping = 0;
    /// Energy taken from the soil by the drag of water, J.
    double drag = 0;
    /// Energy lost by merging points, J; listed by State.
    double merging = 0;
    /// Impulse of the seabed on the soil, N s.
    dealii::Tensor<1, dim> seabed_impulse;
    /// Impulse of walls and tractions on the soil, N s.
    dealii::Tensor<1, dim> wall_impulse;
    /// Impulse of the drag of water on the soil, N s.
    dealii::Tensor<1, dim> drag_impulse;

    Works &
    operator+=(const Works &other)
    {
      gravity += other.gravity;
      friction += other.friction;
      contact += other.contact;
      damping += other.damping;
      drag += other.drag;
      merging += other.merging;
      seabed_impulse += other.seabed_impulse;
      wall_impulse += other.wall_impulse;
      drag_impulse += other.drag_impulse;
      return *this;
    }

    void
    list_state(StateList &list)
    {
      list.add("gravity work", "J", gravity, Reduction::sum);
      list.add("friction work", "J", friction, Reduction::sum);
      list.add("contact work", "J", contact, Reduction::sum);
      list.add("damping work", "J", damping, Reduction::sum);
      list.add("drag work", "J", drag, Reduction::sum);
      list.add_components(
        "seabed impulse", "N s", seabed_impulse, dim, Reduction::sum);
      list.add_components(
        "wall impulse", "N s", wall_impulse, dim, Reduction::sum);
      list.add_components(
        "drag impulse", "N s", drag_impulse, dim, Reduction::sum);
    }
  };
} // namespace talus

#endif

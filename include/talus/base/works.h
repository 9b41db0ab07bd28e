// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_works_h
#define talus_base_works_h

#include <talus/base/state.h>

#include <deal.II/base/tensor.h>

namespace talus
{
  /// What loads, boundaries and damping did to the soil in one step, or in all
  /// steps so far.
  template <int dim>
  struct Works
  {
    /// Work of weight and body forces, J.
    double gravity = 0;
    /// Energy that friction took from the soil, J.
    double friction = 0;
    /// Energy that normal contact, walls and tractions took from the soil, J;
    /// negative where they drive it.
    double contact = 0;
    /// Energy that local damping took from the soil, J.
    double damping = 0;
    /// Energy that the drag of water took from the soil, J.
    double drag = 0;
    /// Energy that merging took from the points, J; listed by State.
    double merging = 0;
    /// Impulse that the seabed gave to the soil, N s.
    dealii::Tensor<1, dim> seabed_impulse;
    /// Impulse that walls and tractions gave to the soil, N s.
    dealii::Tensor<1, dim> wall_impulse;
    /// Impulse that the drag of water gave to the soil, N s.
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_surface_weakening_h
#define talus_problem_surface_weakening_h

#include <talus/boundaries/boundaries.h>
#include <talus/contact/obstacles.h>
#include <talus/interaction/nodal_interaction.h>
#include <talus/problem/trigger.h>

namespace talus
{
  /// Weakens seabeds and surfaces of obstacles by the trigger: multiplies the
  /// maximum shear stresses by the trigger's factor at the end of the step, as
  /// the trigger does with the strength of the points. In a region of the
  /// trigger the factor is the share that softening by slip may go below.
  template <int dim>
  class SurfaceWeakening : public NodalInteraction<dim>
  {
  public:
    SurfaceWeakening(const Trigger<dim> &trigger,
                     Boundaries<dim>    &boundaries,
                     Obstacles<dim>     &obstacles)
      : trigger_(trigger)
      , boundaries_(boundaries)
      , obstacles_(obstacles)
    {}

    void
    begin_step(State<dim> &state) override
    {
      const double factor =
        trigger_.seabed_factor(state.time + state.time_step);
      const bool has_region = boundaries_.seabed().slip().has_region();
      boundaries_.scale_seabed_shear_stress(has_region ? 1. : factor);
      obstacles_.scale_maximum_shear_stress(has_region ? 1. : factor);
      boundaries_.seabed().friction().scale_triggered_region(factor);
      obstacles_.scale_triggered_region(factor);
    }

  private:
    const Trigger<dim> &trigger_;
    Boundaries<dim>    &boundaries_;
    Obstacles<dim>     &obstacles_;
  };
} // namespace talus

#endif

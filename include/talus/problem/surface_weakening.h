// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_surface_weakening_h
#define talus_problem_surface_weakening_h

#include <talus/boundaries/bed.h>
#include <talus/boundaries/bed_slip.h>
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
    /// @param slip tells whether the trigger has a region
    SurfaceWeakening(const Trigger<dim>            &trigger,
                     const std::vector<Bed<dim> *> &beds,
                     const BedSlip<dim>            &slip)
      : trigger_(trigger)
      , beds_(beds)
      , slip_(slip)
    {}

    void
    begin_step(State<dim> &state) override
    {
      const double factor =
        trigger_.seabed_factor(state.time + state.time_step);
      for (Bed<dim> *const bed : beds_)
        {
          bed->scale_shear_stress(slip_.has_region() ? 1. : factor);
          bed->scale_triggered_region(factor);
        }
    }

  private:
    const Trigger<dim>            &trigger_;
    const std::vector<Bed<dim> *> &beds_;
    const BedSlip<dim>            &slip_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_damping_h
#define talus_boundaries_damping_h

#include <talus/boundaries/boundaries.h>

#include <deal.II/base/parameter_acceptor.h>

#include <vector>

namespace talus
{
  /// Local non-viscous damping, which brings a quasi-static problem to rest
  /// (@cite cundall1987): each component of the unbalanced force f of a node is
  /// changed by alpha |f| against the motion. The damping vanishes in
  /// equilibrium and has no time scale. It falsifies a runout, hence is off by
  /// default.
  ///
  /// The motion is the mean velocity of the step, (before + after)/2, because
  /// the work of a force is the product with the mean velocity. Damping at most
  /// stops the motion. So the work taken is never negative, whatever the step:
  /// with the velocity before the step, damping would drive the soil where a
  /// step reverses the motion.
  template <int dim>
  class Damping : public dealii::ParameterAcceptor, public NodalInteraction<dim>
  {
  public:
    /// Two kinds of motion are not damped: components of the velocity that
    /// @p boundaries may hold, because the boundary bears the unbalanced force;
    /// and nodes with a nonzero entry in @p feels_obstacle (by node; empty: no
    /// such node).
    Damping(const Boundaries<dim>            &boundaries,
            const std::vector<unsigned char> &feels_obstacle);

    void
    open_accounts(Accounts<dim> &accounts) override
    {
      accounts.open_energy("damping work");
    }

    /// The coefficient alpha [-]; 0 for none.
    double
    coefficient() const
    {
      return coefficient_;
    }

    void
    correct_velocities(State<dim> &state) override
    {
      state.accounts.energy("damping work") +=
        apply(state.nodes, state.grid, state.constants.mass_cutoff);
    }

    /// Damp the motion of the active nodes with more than @p mass_cutoff, kg,
    /// after the momentum update. Return the energy taken from the soil, J.
    double
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          double            mass_cutoff) const;

  private:
    const Boundaries<dim>            &boundaries_;
    const std::vector<unsigned char> &feels_obstacle_;
    double                            coefficient_ = 0.;
  };
} // namespace talus

#endif

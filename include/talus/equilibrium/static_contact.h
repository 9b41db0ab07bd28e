#ifndef talus_equilibrium_static_contact_h
#define talus_equilibrium_static_contact_h

#include <talus/equilibrium/soil.h>
#include <talus/equilibrium/unknowns.h>

#include <vector>

namespace talus
{
  /// Walls and seabed in equilibrium. Walls hold what they hold. A node on the
  /// seabed sticks to it, slips against the largest friction, or has lifted
  /// off; which of these is found by trial, Newton's method by Newton's method.
  template <int dim>
  class StaticContact
  {
  public:
    /// Find the nodes. Those that were known before stay as they were, the
    /// others stick.
    void
    begin(const Soil<dim> &soil, const Unknowns<dim> &unknowns);

    /// Components that are held, by active node.
    std::vector<unsigned char>
    held(const Soil<dim> &soil, const Unknowns<dim> &unknowns) const;

    /// Add the friction of slipping nodes, N.
    void
    add_friction(std::vector<double> &forces) const;

    /// Look at what became of the nodes: @p reaction, N, is what the boundary
    /// bears and @p u the displacement of the step, m, which is taken back where
    /// soil went into the seabed. Returns how many nodes stick, slip or lift off
    /// now that did not before. Collective.
    unsigned int
    revise(const Soil<dim>           &soil,
           const Unknowns<dim>       &unknowns,
           const std::vector<double> &reaction,
           std::vector<double>       &u);

    /// Nothing holds the soil but friction, and @p residual, N, is out of
    /// balance: it would move along that. Nodes whose friction points the same
    /// way, as where soil that settles has spread, cannot go on slipping: they
    /// stick from now on. Returns how many there are. Collective.
    unsigned int
    hold_back(const Unknowns<dim>       &unknowns,
              const std::vector<double> &residual);

  private:
    enum class State
    {
      sticks,
      slips,
      open
    };

    struct Contact
    {
      unsigned int           node;
      unsigned int           k; ///< its place among the active nodes
      unsigned int           face;
      unsigned char          walls; ///< components that walls hold
      double                 area;  ///< m^(dim-1)
      State                  state = State::sticks;
      dealii::Tensor<1, dim> friction; ///< on the soil, N
    };

    bool
    revise(Contact                      &contact,
           const Seabed<dim>            &seabed,
           const dealii::Tensor<1, dim> &reaction,
           const dealii::Tensor<1, dim> &u,
           double                        weight) const;

    std::vector<Contact> contacts_;
  };
} // namespace talus

#endif

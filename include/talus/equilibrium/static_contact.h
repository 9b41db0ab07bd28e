// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_contact_h
#define talus_equilibrium_static_contact_h

#include <talus/equilibrium/static_facets.h>
#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/unknowns.h>

#include <functional>
#include <vector>

namespace talus
{
  /// Walls, seabed and obstacles in equilibrium. Walls hold what they hold. A
  /// node on the seabed sticks to it, slips against the largest friction, or
  /// has lifted off; which of these is found by trial, Newton's method by
  /// Newton's method.
  template <int dim>
  class StaticContact
  {
  public:
    /// Find the nodes, and the facets of obstacles. Those that were known
    /// before, or by restored tables, stay as they were, but for friction that
    /// exceeds what the seabed bears now; the others stick.
    /// @p modulus, Pa, is the largest shear modulus of the soil. Collective.
    void
    begin(const StaticProblem<dim> &problem,
          const Unknowns<dim>      &unknowns,
          double                    modulus);

    /// Components that are held, by active node.
    std::vector<unsigned char>
    constrained(const StaticProblem<dim> &problem,
                const Unknowns<dim>      &unknowns) const;

    /// Add the friction of slipping nodes, N.
    void
    add_friction(std::vector<double> &forces) const;

    /// Add @p factor times what the seabed bore after the last step: reaction
    /// and friction on the soil, N.
    void
    add_contact_force(double factor, std::vector<double> &forces) const;

    /// Look at what became of the nodes: @p reaction, N, is what the boundary
    /// bears and @p u the displacement of the step, m, which is taken back where
    /// soil went into the seabed. Returns how many nodes stick, slip or lift off
    /// now that did not before, and one more if facets have not come to rest.
    /// Collective.
    unsigned int
    update_active_set(const StaticProblem<dim>  &problem,
                      const Unknowns<dim>       &unknowns,
                      const std::vector<double> &reaction,
                      std::vector<double>       &u);

    /// The soil can move freely along @p direction. Let those slipping nodes
    /// stick whose friction would push it on: when it moves, friction turns
    /// against the motion; facets, too. Returns how many there are. Collective.
    unsigned int
    stick_again(const Unknowns<dim>       &unknowns,
                const std::vector<double> &direction);

    /// Add the tables of seabed and facets, which belong to the points, if
    /// @p is_needed; else they are empty.
    void
    list_state(StateList &list, const std::function<bool()> &is_needed);

    StaticFacets<dim> &
    facets()
    {
      return facets_;
    }

    const StaticFacets<dim> &
    facets() const
    {
      return facets_;
    }

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
      unsigned long          key; ///< of the place of the node
      unsigned int           k;   ///< its place among the active nodes
      unsigned int           face;
      unsigned char          walls; ///< components that walls hold
      double                 area;  ///< m^(dim-1)
      State                  state = State::sticks;
      dealii::Tensor<1, dim> friction; ///< on the soil, N
      dealii::Tensor<1, dim> reaction; ///< the same of what is held
    };

    std::vector<double>
    rows() const;
    void
    take(const std::vector<double> &rows, const Seabed<dim> &seabed);
    void
    limit_friction(Contact &contact, const Seabed<dim> &seabed) const;

    bool
    update_active_set(Contact                      &contact,
                      const Seabed<dim>            &seabed,
                      const dealii::Tensor<1, dim> &reaction,
                      const dealii::Tensor<1, dim> &u,
                      double                        weight) const;

    static constexpr unsigned int n_columns = 4 + 2 * dim; ///< of rows()

    std::vector<Contact> contacts_;
    std::vector<double>  restored_; ///< rows of a checkpoint
    StaticFacets<dim>    facets_;
  };
} // namespace talus

#endif

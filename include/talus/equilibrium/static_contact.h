// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_contact_h
#define talus_equilibrium_static_contact_h

#include <talus/equilibrium/static_facets.h>
#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/unknowns.h>
#include <talus/surface/place_table.h>

#include <functional>
#include <tuple>
#include <vector>

namespace talus
{
  /// Contact with walls, seabed and obstacles in equilibrium. Walls hold their
  /// components always. A node on the seabed sticks, slips against the largest
  /// friction, or has lifted off. The states are found by trial, with a full
  /// Newton solution for each trial.
  template <int dim>
  class StaticContact
  {
  public:
    /// Find the nodes on the seabed and the facets of obstacles. Contacts known
    /// from the previous step or from restored tables keep their state, with
    /// friction cut to the current limit; new contacts stick. @p modulus is the
    /// largest shear modulus of the soil, Pa. Collective.
    void
    begin(const StaticProblem<dim> &problem,
          const Unknowns<dim>      &unknowns,
          double                    modulus);

    /// Components held by walls and contact, for each active node: bit d for
    /// axis d.
    std::vector<unsigned char>
    constrained(const StaticProblem<dim> &problem,
                const Unknowns<dim>      &unknowns) const;

    /// Set the slip of slipping nodes from the displacements @p u of the step,
    /// m, where the seabed softens.
    void
    set_slip(const std::vector<double> &u);

    /// Add the friction of slipping nodes on the soil after the slip of
    /// set_slip(), N, to @p forces.
    void
    add_friction(std::vector<double> &forces) const;

    /// Add the negative derivative of the last add_friction() to @p matrix.
    void
    add_to_matrix(StiffnessMatrix<dim> &matrix) const;

    /// Store the slip of the displacements @p u, m, at the places of seabed and
    /// obstacles, and the forces of facets.
    void
    commit(const StaticProblem<dim>  &problem,
           const std::vector<double> &u,
           StrainMeasure              measure);

    /// Add @p factor times the force of the seabed on the soil after the last
    /// step, reaction and friction, N, to @p forces.
    void
    add_contact_force(double factor, std::vector<double> &forces) const;

    /// Update the contact states from a solution. Soil that has moved into the
    /// seabed is moved back. Collective.
    /// @param problem Soil and boundaries.
    /// @param unknowns Unknowns of the load step.
    /// @param reaction Force of the boundary on the soil, N, at the nodes.
    /// @param u Displacement of the step, m, at the nodes.
    /// @param facet_tolerance See StaticFacets::update() [-].
    /// @return Number of nodes on all ranks whose state or friction changed,
    ///   plus 1 if the forces of the facets have not converged.
    unsigned int
    update_active_set(const StaticProblem<dim>  &problem,
                      const Unknowns<dim>       &unknowns,
                      const std::vector<double> &reaction,
                      std::vector<double>       &u,
                      double                     facet_tolerance);

    /// Let slipping nodes and facets stick again if their friction would push
    /// the soil along @p direction, in which the soil moves freely: as soon as
    /// the soil moves, friction reverses. Returns the number of changes on all
    /// ranks. Collective.
    unsigned int
    stick_again(const Unknowns<dim>       &unknowns,
                const std::vector<double> &direction);

    /// Add the tables of seabed and facets, which belong to the points, to the
    /// state. Without @p is_needed the tables are empty.
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
      unsigned int  node;
      unsigned int  k;     ///< index among the active nodes
      unsigned int  place; ///< number in FacetConstraints
      unsigned int  face;
      unsigned char walls; ///< components held by walls, as bits
      double        area;  ///< m^(dim-1)
      CoulombLimit  limit; ///< at the start of the step
      State         state        = State::sticks;
      double        slip         = 0; ///< in the step, m
      double        normal_force = 0; ///< limits friction, N
      /// On the soil without slip in the step, N.
      dealii::Tensor<1, dim> friction;
      dealii::Tensor<1, dim> reaction; ///< on the soil, held components, N

      dealii::Tensor<1, dim>
      friction_after_slip() const;
      double
      softening() const;

      // Row of a PlaceTable
      static constexpr unsigned int n_keys = 4;
      static constexpr const char  *columns =
        "key of the place of the node: upper and lower 32 bits; 0; face; "
        "state; "
        "friction [N]; reaction [N]";

      bool
      is_kept() const
      {
        return true;
      }

      auto
      values()
      {
        return std::tie(state, friction, reaction);
      }
    };

    void
    limit_friction(Contact &contact) const;

    bool
    update_active_set(Contact                      &contact,
                      const dealii::Tensor<1, dim> &reaction,
                      const dealii::Tensor<1, dim> &u,
                      double                        weight) const;

    PlaceTable<Contact> contacts_;
    StaticFacets<dim>   facets_;
  };
} // namespace talus

#endif

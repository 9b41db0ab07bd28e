// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_facets_h
#define talus_equilibrium_static_facets_h

#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/stiffness_matrix.h>
#include <talus/equilibrium/unknowns.h>
#include <talus/surface/place_table.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <array>
#include <functional>
#include <tuple>
#include <vector>

namespace talus
{
  /// Contact with obstacles in equilibrium: at the contact point of each facet
  /// the soil sticks, slips against the largest friction, or has lifted off. By
  /// augmented Lagrangians @cite alart1991, the force of a facet is a given
  /// force plus the force of a stiff spring, cut to the limits of contact. When
  /// Newton's method has converged, the computed force becomes the given force
  /// of the next loop, until the springs carry nothing.
  template <int dim>
  class StaticFacets
  {
  public:
    /// Find the contact points. The initial forces are the forces of the facets
    /// in @p problem, cut to the current friction. Contact points known from
    /// the previous step or a checkpoint keep their gaps. @p modulus is the
    /// shear modulus of the soil, Pa. Collective.
    void
    begin(const StaticProblem<dim> &problem,
          const Unknowns<dim>      &unknowns,
          double                    modulus);

    /// Compute the contact forces on the soil at the displacements @p u of the
    /// step, m, and add them times @p factor to @p forces, N; nodes of this
    /// rank and ghosts.
    void
    add_forces(double                     factor,
               const std::vector<double> &u,
               std::vector<double>       &forces);

    /// Add to @p forces, N, the force of the pressure @p pressure(x), Pa, on
    /// the facets in contact: p A n, with the area in contact, distributed to
    /// the nodes with the weights of the contact forces.
    void
    add_pressure(
      const std::function<double(const dealii::Point<dim> &)> &pressure,
      std::vector<double>                                     &forces) const;

    /// Couple the nodes of each contact point in the pattern of @p matrix:
    /// nodes of a cut cell are coupled even without points in the cell.
    void
    couple(StiffnessMatrix<dim> &matrix) const;

    /// Add the negative derivative of the last add_forces() to @p matrix.
    void
    add_to_matrix(StiffnessMatrix<dim> &matrix);

    /// Return whether the matrix is always symmetric: only without friction
    /// coefficients.
    bool
    is_symmetric() const
    {
      return is_symmetric_;
    }

    /// Make the forces computed with the displacements @p u, m, the given
    /// forces of the next loop. Returns whether the loops may end: facets give
    /// way by less than @p tolerance times the largest displacement, so the
    /// soil neither enters obstacles nor moves where it sticks, or the number
    /// of loops is used up. Collective.
    bool
    update(const StaticProblem<dim>  &problem,
           const Unknowns<dim>       &unknowns,
           const std::vector<double> &u,
           double                     tolerance);

    /// Let slipping contact points start by sticking if their friction would
    /// push the soil along @p direction. Returns the number of changes on this
    /// rank.
    unsigned int
    stick_again(const std::vector<double> &direction);

    /// Store the solution with the displacements @p u, m, as the forces of the
    /// facets in @p problem.
    void
    commit(const StaticProblem<dim>  &problem,
           const std::vector<double> &u,
           StrainMeasure              measure);

    /// Add the displacements and normal forces of the contact points to the
    /// state. Without @p is_needed the table is empty. The forces of facets are
    /// also stored in FacetImpulses.
    void
    list_state(StateList &list, const std::function<bool()> &is_needed)
    {
      points_.list_state("static contact with obstacles", list, is_needed);
    }

  private:
    static constexpr unsigned int n_nodes = ContactFacet<dim>::n_nodes;

    struct Force
    {
      double                 normal = 0; ///< on the soil, N
      dealii::Tensor<1, dim> tangential; ///< N
    };

    struct ContactPoint
    {
      std::array<unsigned int, n_nodes> node;
      std::array<double, n_nodes>       share;
      dealii::Point<dim>                place; ///< centroid, m
      dealii::Tensor<1, dim>            normal;
      double                            area = 0; ///< in contact, m^(dim-1)
      double stiffness                       = 0; ///< spring, N/m; 0: no soil
      double gap    = 0;            ///< at the start of the step, m
      double opened = 0;            ///< normal displacement since the
                                    ///< points were last moved, m
      CoulombLimit           limit; ///< limit of friction
      Force                  given, found;
      bool                   is_closed = false, slips = false;
      dealii::Tensor<1, dim> direction; ///< direction of friction when slipping
      double                 cut  = 0;  ///< friction over spring force [-]
      double                 slip = 0; ///< in the step where the point slips, m
      bool sticks_first           = false; ///< next tangent as if it stuck

      // Row of a PlaceTable
      static constexpr unsigned int n_keys = 4;
      static constexpr const char  *columns =
        "key of the cell or of the place of the node: upper and lower 32 bits; "
        "obstacle; number of the facet in its cell, -1 for a node; normal "
        "displacement [m]; normal force [N]";

      bool
      is_kept() const
      {
        return opened != 0 || found.normal > 0;
      }

      auto
      values()
      {
        return std::tie(opened, found.normal);
      }
    };

    void
    set_facets(const StaticProblem<dim> &problem, double modulus);
    void
    set_nodes_inside(const StaticProblem<dim> &problem,
                     const Unknowns<dim>      &unknowns,
                     double                    modulus);
    dealii::Tensor<1, dim>
    displacement(const ContactPoint &point, const std::vector<double> &u) const;
    void
    find_force(ContactPoint &point, const std::vector<double> &u) const;
    dealii::Tensor<2, dim>
                 tangent(const ContactPoint &point) const;
    bool         is_symmetric_ = true;
    unsigned int n_loops_      = 0; ///< in this load step
    unsigned int n_facets_     = 0;
    /// Contact points of the facets of this rank, followed by the contact
    /// points of nodes inside obstacles that touch no facet.
    PlaceTable<ContactPoint> points_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_facets_h
#define talus_equilibrium_static_facets_h

#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/unknowns.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace talus
{
  /// Obstacles in equilibrium: at the contact point of each facet the soil
  /// sticks, slips against the largest friction, or has lifted off. By augmented
  /// Lagrangians, @cite alart1991, a facet passes the force that is given plus
  /// that of a stiff spring, cut to what it can bear; when Newton's method has
  /// converged, the force found is the one given for the next loop, until the
  /// spring has nothing to do.
  template <int dim>
  class StaticFacets
  {
  public:
    /// Find the contact points. They bear what the facets of @p problem bore,
    /// but no more friction than they bear now. Points that were known before,
    /// or that restore() was given, remember their gaps. @p modulus, Pa, of the
    /// soil. Collective.
    void
    begin(const StaticProblem<dim> &problem,
          const Unknowns<dim>      &unknowns,
          double                    modulus);

    /// Add @p factor times their forces on the soil, N, with the displacements
    /// @p u of the step, m, to those of this rank's nodes and ghosts.
    void
    add_forces(double                     factor,
               const std::vector<double> &u,
               std::vector<double>       &forces);

    /// Add to @p forces, N, those of the pressure @p pressure(x), Pa, on the
    /// facets in contact: p A n, with the area in contact and the shares of the
    /// nodes by which facets pass their own forces.
    void
    add_pressure(
      const std::function<double(const dealii::Point<dim> &)> &pressure,
      std::vector<double>                                     &forces) const;

    void
    add_to_pattern(const Unknowns<dim>                       &unknowns,
                   dealii::TrilinosWrappers::SparsityPattern &pattern) const;

    /// Add the derivative, with its sign changed, of the last add_forces().
    void
    add_to_matrix(const Unknowns<dim>                    &unknowns,
                  dealii::TrilinosWrappers::SparseMatrix &matrix);

    /// Whether the matrix always is; that of friction by a coefficient is not.
    bool
    is_symmetric() const
    {
      return is_symmetric_;
    }

    /// Give the points the forces that were found with @p u. Returns whether
    /// these are nearly those that were given, so that nothing moves into an
    /// obstacle, or along it where it sticks, or enough was tried. Collective.
    bool
    update(const StaticProblem<dim>  &problem,
           const Unknowns<dim>       &unknowns,
           const std::vector<double> &u);

    /// Let those slipping points stick, to begin with, whose friction would
    /// push the soil along @p direction. Returns how many these are, on this
    /// rank.
    unsigned int
    stick_again(const std::vector<double> &direction);

    /// Make what was found with @p u the forces of the facets of @p problem.
    void
    commit(const StaticProblem<dim>  &problem,
           const std::vector<double> &u,
           StrainMeasure              measure);

    /// Return what the contact points of this rank remember, one row each: name
    /// (see ContactPoint), normal displacement since points were last moved, m,
    /// normal force, N. Forces of facets are those of FacetImpulses, too.
    std::vector<double>
    rows() const;

    /// Keep the @p rows of all ranks for the next begin().
    void
    restore(const std::vector<double> &rows)
    {
      restored_ = rows;
    }

    static constexpr unsigned int n_columns = 6; ///< of rows()

  private:
    static constexpr unsigned int n_nodes = ContactFacet<dim>::n_nodes;

    struct Force
    {
      double                 normal = 0; ///< on the soil, N
      dealii::Tensor<1, dim> tangential; ///< N
    };

    struct ContactPoint
    {
      /// Name of the facet; for a node inside, key of the node (two numbers),
      /// obstacle, -1.
      FacetName                         name;
      std::array<unsigned int, n_nodes> node;
      std::array<double, n_nodes>       share;
      dealii::Point<dim>                place; ///< centroid, m
      dealii::Tensor<1, dim>            normal;
      double                            area = 0; ///< in contact, m^(dim-1)
      double stiffness        = 0; ///< of the spring, N/m; 0: there is no soil
      double gap              = 0; ///< at the start of the step, m
      double opened           = 0; ///< since points were last moved, m
      double coefficient      = 0; ///< of friction
      double largest_friction = 0; ///< whatever the normal force, N
      Force  given, found;
      bool   is_closed = false, slips = false;
      dealii::Tensor<1, dim> direction; ///< of friction where it slips
      double                 cut = 0;   ///< what is left of the spring's, there
      bool sticks_first = false;        ///< in the next matrix, though it slips
    };

    /// State of a contact point that passes from load step to load step.
    struct Memory
    {
      double opened; ///< normal displacement since points were last moved, m
      double force;  ///< normal, N
    };
    using Memories = std::map<FacetName, Memory>;

    Memories
    memories() const;
    void
    add_facets(const StaticProblem<dim> &problem,
               const Memories           &before,
               double                    modulus);
    void
    add_nodes_inside(const StaticProblem<dim> &problem,
                     const Unknowns<dim>      &unknowns,
                     const Memories           &before,
                     double                    modulus);
    dealii::Tensor<1, dim>
    displacement(const ContactPoint &point, const std::vector<double> &u) const;
    void
    find_force(ContactPoint &point, const std::vector<double> &u) const;
    dealii::Tensor<2, dim>
                 tangent(const ContactPoint &point) const;
    bool         is_symmetric_ = true;
    unsigned int n_loops_      = 0; ///< of this step
    unsigned int n_facets_     = 0;
    /// Those of the facets of this rank, then those of nodes inside that touch
    /// no facet.
    std::vector<ContactPoint> points_;
    std::vector<double>       restored_; ///< rows of a checkpoint
  };
} // namespace talus

#endif

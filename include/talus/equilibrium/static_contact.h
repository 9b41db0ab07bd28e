// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_equilibrium_static_contact_h
#define talus_equilibrium_static_contact_h

#include <talus/equilibrium/static_problem.h>
#include <talus/equilibrium/stiffness_matrix.h>
#include <talus/surface/place_table.h>

#include <array>
#include <functional>
#include <tuple>
#include <vector>

namespace talus
{
  /// State of soil at a place of a surface; open: the soil has lifted off.
  enum class ContactState
  {
    sticks,
    slips,
    open
  };



  /// Contact of soil with a place of a surface in equilibrium: a facet of an
  /// obstacle, a node inside an obstacle, or a node on a seabed face of the
  /// mesh. The soil sticks, slips against the largest friction, or has lifted
  /// off.
  template <int dim>
  struct StaticPlace
  {
    static constexpr unsigned int max_nodes = ContactFacet<dim>::n_nodes;

    unsigned int                        n_nodes = 0; ///< 0: no soil
    std::array<unsigned int, max_nodes> node;
    std::array<double, max_nodes>       share;    ///< shares of the force [-]
    dealii::Point<dim>                  centroid; ///< centroid of a facet, m
    dealii::Tensor<1, dim>              normal;   ///< into the soil
    double area      = 0; ///< area of a facet in contact, m^(dim-1)
    double stiffness = 0; ///< spring, N/m; 0: node on a face of the mesh
    double gap       = 0; ///< at the start of the step, m
    double opened    = 0; ///< normal displacement since the points were
                          ///< last moved, m
    unsigned int           number = 0; ///< number in ContactConstraints
    CoulombLimit           limit;      ///< limit of friction at the start
    ContactState           state = ContactState::sticks;
    dealii::Tensor<1, dim> given, force; ///< on the soil, N
    dealii::Tensor<1, dim> direction;    ///< direction of friction
    double                 cut  = 0;     ///< friction over trial friction [-]
    double                 slip = 0;     ///< in the step, where slip softens, m
    bool sticks_first           = false; ///< next tangent as if the soil stuck

    void
    add_node(const unsigned int index, const double weight)
    {
      if (weight > 0)
        {
          node[n_nodes]    = index;
          share[n_nodes++] = weight;
        }
    }

    /// Displacement of the place, m; zero if @p u is empty.
    dealii::Tensor<1, dim>
    displacement(const std::vector<double> &u) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int v = 0; v < (u.empty() ? 0 : n_nodes); ++v)
        for (unsigned int d = 0; d < dim; ++d)
          result[d] += share[v] * u[std::size_t(dim) * node[v] + d];
      return result;
    }

    /// Add @p on_soil, N, to the nodal field @p forces.
    void
    distribute(const dealii::Tensor<1, dim> &on_soil,
               std::vector<double>          &forces) const
    {
      for (unsigned int v = 0; v < n_nodes; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          forces[std::size_t(dim) * node[v] + d] += share[v] * on_soil[d];
    }

    /// Part of @p vector along the surface.
    dealii::Tensor<1, dim>
    tangential(const dealii::Tensor<1, dim> &vector) const
    {
      return vector - (vector * normal) * normal;
    }

    /// Begin a load step from the given force.
    void
    begin();

    /// Compute the force at the displacements @p u of the step, m.
    void
    find_force(const std::vector<double> &u);

    /// Negative derivative of the force by the displacement, N/m.
    dealii::Tensor<2, dim>
    tangent() const;

    /// Update state and given force of a node on a face of the mesh after a
    /// solution with the displacements @p u, m. Returns whether the state or
    /// the friction changed.
    /// @param reaction Force on the soil that @p u needs, N.
    /// @param walls Components that walls hold: bit d for axis d.
    /// @param u Displacements of the step, m.
    /// @param tolerance Force that does not matter, N.
    bool
    update(const dealii::Tensor<1, dim> &reaction,
           unsigned char                 walls,
           const std::vector<double>    &u,
           double                        tolerance);

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 4;
    static constexpr const char  *columns =
      "key of the cell or of the place of the node: upper and lower 32 bits; 0 "
      "for the seabed or 1 + obstacle; number of the facet in its cell, -1 for "
      "a "
      "node inside an obstacle, or face of the mesh; state; normal "
      "displacement "
      "[m]; force [N]";

    bool
    is_kept() const
    {
      return n_nodes > 0;
    }

    auto
    values()
    {
      return std::tie(state, opened, given);
    }
  };



  /// Contact with seabed and obstacles in equilibrium. By augmented Lagrangians
  /// @cite alart1991, the force of a place is a given force plus the force of a
  /// stiff spring, cut to the limits of contact. When Newton's method has
  /// converged, the computed force becomes the given force of the next loop,
  /// until the springs carry nothing. Nodes on faces of the mesh need no
  /// springs: their unknowns are held, and the residual there is the change of
  /// the force. States of such nodes change between the loops only.
  template <int dim>
  class StaticContact
  {
  public:
    /// Find the places. Places known from the previous step or from a
    /// checkpoint keep state, force and gap, with friction cut to the current
    /// limit; at new places the soil sticks without force. @p modulus is the
    /// largest shear modulus of the soil, Pa. Collective.
    void
    begin(const StaticProblem<dim> &problem,
          const Unknowns<dim>      &unknowns,
          double                    modulus);

    /// Read the limits of friction again, after a change of the strength of
    /// beds.
    void
    renew_limits(const StaticProblem<dim> &problem)
    {
      for (auto &place : places_)
        if (place.area > 0. || (place.n_nodes > 0 && place.stiffness == 0.))
          place.limit = problem.contact.constraints().limit(place.number);
    }

    /// Components held by walls and by contact, by node: bit d for axis d.
    std::vector<unsigned char>
    held(const StaticProblem<dim> &problem,
         const Unknowns<dim>      &unknowns) const;

    /// Compute the contact forces on the soil at the displacements @p u of the
    /// step, m, and add them times @p factor to @p forces, N; nodes of this
    /// rank and ghosts. Held components have the given force.
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

    /// Couple the nodes of each place in the pattern of @p matrix: nodes of a
    /// cut cell are coupled even without points in the cell.
    void
    couple(StiffnessMatrix<dim> &matrix) const;

    /// Add the negative derivative of the last add_forces() to @p matrix.
    void
    add_to_matrix(StiffnessMatrix<dim> &matrix);

    /// Return whether the matrix is always symmetric: only without friction
    /// coefficients of obstacles.
    bool
    is_symmetric() const
    {
      return is_symmetric_;
    }

    /// Update states and given forces from a solution with the displacements
    /// @p u of the step, m, and the @p residual, N. Soil that has moved into a
    /// face of the mesh is moved back. Returns the number of nodes on all ranks
    /// whose state or friction changed, plus 1 if springs give way by more than
    /// @p tolerance times the largest displacement, as long as loops for
    /// springs are left. Collective.
    unsigned int
    update(const StaticProblem<dim>  &problem,
           const Unknowns<dim>       &unknowns,
           const std::vector<double> &residual,
           std::vector<double>       &u,
           double                     tolerance);

    /// Let slipping soil stick again where the friction would push the soil
    /// along @p direction, in which the soil moves freely: as soon as the soil
    /// moves, friction reverses. Springs stick for the next matrix only.
    /// Returns the number of changes on all ranks. Collective.
    unsigned int
    stick_again(const Unknowns<dim>       &unknowns,
                const std::vector<double> &direction);

    /// Store the solution with the displacements @p u, m: the slip at the
    /// places of seabed and obstacles, and the forces of the facets.
    void
    commit(const StaticProblem<dim> &problem, const std::vector<double> &u);

    /// Add the table of the places to the state. Without @p is_needed the table
    /// is empty.
    void
    list_state(StateList &list, const std::function<bool()> &is_needed)
    {
      places_.list_state("static contact", list, is_needed);
    }

  private:
    using Places = PlaceTable<StaticPlace<dim>>;

    unsigned int
    update_held(const StaticProblem<dim>  &problem,
                const Unknowns<dim>       &unknowns,
                const std::vector<double> &residual,
                std::vector<double>       &u);

    bool         is_symmetric_ = true;
    unsigned int n_loops_      = 0; ///< in this load step
    Places       places_;           ///< facets of this rank come first
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundaries_h
#define talus_boundaries_boundaries_h

#include <talus/base/works.h>
#include <talus/boundaries/face_expression.h>
#include <talus/boundaries/seabed.h>
#include <talus/grid/nodal_fields.h>

#include <deal.II/base/parameter_acceptor.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace talus
{
  enum class FaceCondition
  {
    free,     ///< nothing; a point that crosses the face has left
    roller,   ///< no motion along the normal, in either direction
    fixed,    ///< no motion
    seabed,   ///< one-sided contact with friction
    periodic, ///< what leaves here enters through the opposite face
    velocity, ///< velocity by expression, for some components or all
    traction  ///< force per area by expression
  };

  /// Conditions on the faces of the mesh.
  ///
  /// A node on several faces: tractions are forces and come first, of all
  /// faces. `fixed` holds all components. Else a component that several faces
  /// with `velocity` prescribe is that of the face whose normal it is, or else
  /// of the first of them; rollers then hold their normals, since nothing may
  /// pass a wall. The seabed acts last, on what is so prescribed, but moves only
  /// the other components.
  template <int dim>
  class Boundaries : public dealii::ParameterAcceptor
  {
  public:
    Boundaries();

    /// To be called after parsing. Throws ExcUser if conditions and expressions
    /// contradict each other.
    void
    prepare(const Constants &constants);

    /// Find the places of the nodes that expressions are needed at; to be
    /// called after each change of the mesh or its partition.
    void
    locate_nodes(const Grid<dim> &grid);

    FaceCondition
    condition(const unsigned int face) const
    {
      return conditions_[face];
    }

    bool
    has_seabed() const;

    /// Let the seabed pass @p factor times its maximum shear stress [-].
    void
    scale_seabed_shear_stress(const double factor)
    {
      seabed_.scale_maximum_shear_stress(factor);
    }

    /// From now on all that resists sliding on the seabed is @p factor times
    /// its parameter [-].
    void
    scale_seabed_strength(const double factor)
    {
      seabed_.scale_maximum_shear_stress(factor);
      seabed_.scale_friction_coefficient(factor);
    }

    /// Axes whose two faces are periodic. Throws ExcUser if only one is.
    std::array<bool, dim>
    periodic_axes() const;

    /// Bit d is set if walls hold a node on these faces (see
    /// Grid::faces_of_node) along axis d, or drive it.
    unsigned char
    components_constrained_by_walls(unsigned char faces) const;

    const Seabed<dim> &
    seabed() const
    {
      return seabed_;
    }

    /// Bit d is set if a node on these faces may be held along axis d, by a
    /// wall or by the seabed.
    unsigned char
    constrained_components(unsigned char faces) const;

    /// Add the tractions at time @p t, s, to the forces of the active nodes on
    /// the faces, before the momentum update. Nodes with less than
    /// @p mass_cutoff carry nothing and are left alone, here and in apply().
    void
    add_tractions(NodalFields<dim> &nodes,
                  const Grid<dim>  &grid,
                  double            t,
                  double            mass_cutoff);

    /// Give a node on @p faces the velocity that walls prescribe for time @p t,
    /// s. Returns the impulse that this takes, N s.
    dealii::Tensor<1, dim>
    impose_walls(NodalFields<dim> &nodes,
                 unsigned char     faces,
                 unsigned int      node,
                 double            t);

    /// Change the velocities of the active nodes on the faces as their
    /// conditions ask, after the momentum update of a step from time @p t over
    /// @p dt; velocities are those of the half step, t + dt/2. Returns what the
    /// boundaries did, the tractions added before included.
    Works<dim>
    apply(NodalFields<dim> &nodes,
          const Grid<dim>  &grid,
          double            t,
          double            dt,
          double            mass_cutoff);

  private:
    using Expressions =
      std::array<std::unique_ptr<FaceExpression<dim>>, 2 * dim>;

    /// Components of a node's velocity that do not depend on what the soil does.
    struct PrescribedVelocity
    {
      std::array<bool, dim>  is_prescribed = {};
      dealii::Tensor<1, dim> velocity; ///< m/s

      void
      set(unsigned int component, double value);

      /// Give them to a node; returns the impulse that this takes, N s.
      dealii::Tensor<1, dim>
      impose(NodalFields<dim> &nodes, unsigned int node) const;
    };

    template <typename Action>
    void
    for_faces_with(FaceCondition condition,
                   unsigned char faces,
                   const Action &action) const;
    void
    check_expression(unsigned int       face,
                     FaceCondition      condition,
                     const std::string &text) const;
    PrescribedVelocity
    prescribed_velocity(unsigned char faces, unsigned int node, double t);
    void
    apply_to_node(NodalFields<dim> &nodes,
                  const Grid<dim>  &grid,
                  unsigned int      node,
                  double            t,
                  double            dt,
                  Works<dim>       &work);

    // Parameters, by face
    std::array<std::string, 2 * dim> names_;
    std::array<std::string, 2 * dim> velocity_texts_;
    std::array<std::string, 2 * dim> traction_texts_;

    std::array<FaceCondition, 2 * dim> conditions_;
    Seabed<dim>                        seabed_;
    Expressions                        velocities_; // m/s
    Expressions                        tractions_;  // Pa

    /// Of the owned nodes, by node, if there are expressions; m.
    std::vector<dealii::Point<dim>> places_;
    /// Nodes with tractions in this step, and the forces, N.
    std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> loaded_;
  };
} // namespace talus

#endif

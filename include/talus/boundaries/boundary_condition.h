// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_condition_h
#define talus_boundaries_boundary_condition_h

#include <talus/base/expression.h>
#include <talus/boundaries/velocity_constraints.h>

#include <string>

namespace talus
{
  /// Arguments of the constructor of a condition.
  template <int dim>
  struct FaceDescription
  {
    unsigned int       face;     ///< number, in deal.II's order
    const std::string &velocity; ///< expressions
    const std::string &traction; ///< expressions
    const Constants   &constants;
  };



  /// Condition on a face of the mesh. A derived class provides constraints on
  /// the velocity of a node, independent of the state of the soil, or a
  /// traction, or both.
  template <int dim>
  class BoundaryCondition
  {
  public:
    explicit BoundaryCondition(const FaceDescription<dim> &description)
      : face_(description.face)
    {}

    virtual ~BoundaryCondition() = default;

    /// Number of the face, in deal.II's order.
    unsigned int
    face() const
    {
      return face_;
    }

    /// Whether a node on @p faces (see Grid::faces_of_node()) lies on the face.
    bool
    acts_on(const unsigned char faces) const
    {
      return faces & (1u << face_);
    }

    /// Whether the condition needs the places of nodes.
    virtual bool
    depends_on_place() const
    {
      return false;
    }

    /// Whether the condition prescribes component @p d of the velocity.
    virtual bool
    constrains(const unsigned int /*d*/) const
    {
      return false;
    }

    /// Set the constraints of the condition at a node at @p x, m, time @p t, s;
    /// constraints of earlier conditions along the same direction may be
    /// replaced. @p owner: number of the condition, stored in the constraints.
    virtual void
    constrain(const dealii::Point<dim> & /*x*/,
              const double /*t*/,
              const unsigned int /*owner*/,
              VelocityConstraints<dim> & /*constraints*/)
    {}

    /// Whether the condition has a traction.
    virtual bool
    has_traction() const
    {
      return false;
    }

    /// Force per area in contact, Pa, at @p x, m, time @p t, s; independent of
    /// the state of the soil.
    virtual dealii::Tensor<1, dim>
    traction(const dealii::Point<dim> & /*x*/, const double /*t*/)
    {
      return {};
    }

  private:
    unsigned int face_;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_condition_h
#define talus_boundaries_boundary_condition_h

#include <talus/base/assertion.h>
#include <talus/base/expression.h>
#include <talus/grid/nodal_fields.h>

#include <array>
#include <string>

namespace talus
{
  /// Prescribed velocity of a node along a direction.
  template <int dim>
  struct VelocityConstraint
  {
    dealii::Tensor<1, dim> normal;   ///< the direction, a unit vector
    double                 velocity; ///< along `normal`, m/s
    unsigned int           owner;    ///< number of the condition
  };



  /// All constraints on the velocity of a node, along orthogonal directions.
  template <int dim>
  class VelocityConstraints
  {
  public:
    /// Whether the velocity along @p normal is prescribed.
    bool
    has(const dealii::Tensor<1, dim> &normal) const
    {
      for (unsigned int k = 0; k < size_; ++k)
        if (list_[k].normal == normal)
          return true;
      return false;
    }

    /// Add a constraint, or replace the constraint along the same direction.
    void
    set(const VelocityConstraint<dim> &constraint)
    {
      unsigned int k = 0;
      while (k < size_ && list_[k].normal != constraint.normal)
        ++k;
      TalusAssert(k < dim, dealii::ExcIndexRange(k, 0, dim));
      list_[k] = constraint;
      size_    = std::max(size_, k + 1);
    }

    /// Set the velocity of @p node to the prescribed velocities; return the
    /// impulse needed, N s.
    dealii::Tensor<1, dim>
    impose(NodalFields<dim> &nodes, const unsigned int node) const
    {
      dealii::Tensor<1, dim> v = nodes.velocity(node);
      for (const VelocityConstraint<dim> &constraint : *this)
        {
          // Subtract first: the result is exact to the last digit.
          v -= (v * constraint.normal) * constraint.normal;
          v += constraint.velocity * constraint.normal;
        }
      return nodes.set_velocity(node, v);
    }

    const VelocityConstraint<dim> *
    begin() const
    {
      return list_.data();
    }

    const VelocityConstraint<dim> *
    end() const
    {
      return list_.data() + size_;
    }

  private:
    std::array<VelocityConstraint<dim>, dim> list_;
    unsigned int                             size_ = 0;
  };



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

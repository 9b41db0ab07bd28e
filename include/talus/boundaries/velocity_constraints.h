// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_velocity_constraints_h
#define talus_boundaries_velocity_constraints_h

#include <talus/base/assertion.h>
#include <talus/grid/nodal_fields.h>

#include <array>

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
} // namespace talus

#endif

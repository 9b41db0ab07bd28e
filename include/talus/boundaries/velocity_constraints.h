// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_velocity_constraints_h
#define talus_boundaries_velocity_constraints_h

#include <talus/grid/nodal_fields.h>

#include <array>

namespace talus
{
  /// A node's velocity along one direction is given.
  template <int dim>
  struct VelocityConstraint
  {
    dealii::Tensor<1, dim> normal;   ///< the direction, a unit vector
    double                 velocity; ///< along it, m/s
    unsigned int           owner;    ///< number of the condition that gives it
  };



  /// All constraints on the velocity of one node, along directions that are
  /// orthogonal to each other.
  template <int dim>
  class VelocityConstraints
  {
  public:
    /// Whether the velocity along @p normal is given.
    bool
    has(const dealii::Tensor<1, dim> &normal) const
    {
      for (unsigned int k = 0; k < size_; ++k)
        if (list_[k].normal == normal)
          return true;
      return false;
    }

    /// Add a constraint, or put it in the place of that along the same direction.
    void
    set(const VelocityConstraint<dim> &constraint)
    {
      unsigned int k = 0;
      while (k < size_ && list_[k].normal != constraint.normal)
        ++k;
      AssertIndexRange(k, dim);
      list_[k] = constraint;
      size_    = std::max(size_, k + 1);
    }

    /// Give the node the velocity that they ask for; returns the impulse that
    /// this takes, N s.
    dealii::Tensor<1, dim>
    impose(NodalFields<dim> &nodes, const unsigned int node) const
    {
      dealii::Tensor<1, dim> v = nodes.velocity(node);
      for (const VelocityConstraint<dim> &constraint : *this)
        {
          // First away with it: so it becomes what is given to the last digit.
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

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_boundary_condition_h
#define talus_boundaries_boundary_condition_h

#include <talus/base/expression.h>
#include <talus/boundaries/velocity_constraints.h>

#include <string>
#include <utility>

namespace talus
{
  template <int dim>
  class Seabed;



  /// What a condition is made from.
  template <int dim>
  struct FaceDescription
  {
    unsigned int       face;     ///< its number, as deal.II counts them
    const std::string &velocity; ///< expressions
    const std::string &traction; ///< expressions
    const Constants   &constants;
    Seabed<dim>       &seabed;
  };



  /// What a face of the mesh does to the soil. Whoever derives from it says so
  /// by one or several of: constraints on the velocity of a node, which do not
  /// depend on what the soil does; a force; one-sided contact.
  template <int dim>
  class BoundaryCondition
  {
  public:
    explicit BoundaryCondition(const FaceDescription<dim> &description)
      : face_(description.face)
    {}

    virtual ~BoundaryCondition() = default;

    /// Number of the face, as deal.II counts them.
    unsigned int
    face() const
    {
      return face_;
    }

    /// Whether a node on @p faces (see Grid::faces_of_node()) lies on it.
    bool
    acts_on(const unsigned char faces) const
    {
      return faces & (1u << face_);
    }

    /// Whether it asks for the place of a node.
    virtual bool
    depends_on_place() const
    {
      return false;
    }

    /// Whether it holds or drives component @p d of the velocity.
    virtual bool
    constrains(const unsigned int /*d*/) const
    {
      return false;
    }

    /// Set its constraints at a node at @p x, time @p t, in place of those of
    /// conditions that acted before it; they bear the number @p owner.
    virtual void
    constrain(const dealii::Point<dim> & /*x*/,
              const double /*t*/,
              const unsigned int /*owner*/,
              VelocityConstraints<dim> & /*constraints*/)
    {}

    /// Whether it passes a force that does not depend on what the soil does.
    virtual bool
    has_traction() const
    {
      return false;
    }

    /// That force per area in contact, Pa, at @p x, time @p t.
    virtual dealii::Tensor<1, dim>
    traction(const dealii::Point<dim> & /*x*/, const double /*t*/)
    {
      return {};
    }

    /// Whether soil may lift off and slide along it.
    virtual bool
    is_one_sided() const
    {
      return false;
    }

    /// Change the velocity of @p node after a step of @p dt, s, at whose start
    /// the soil was farther from the face by @p gap, m, than contact needs.
    /// Returns the normal and the tangential impulse on the soil, N s.
    virtual std::pair<dealii::Tensor<1, dim>, dealii::Tensor<1, dim>>
    apply_contact(NodalFields<dim> & /*nodes*/,
                  const Grid<dim> & /*grid*/,
                  const unsigned int /*node*/,
                  const double /*dt*/,
                  const double /*gap*/)
    {
      return {};
    }

  private:
    unsigned int face_;
  };
} // namespace talus

#endif

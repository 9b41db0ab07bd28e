// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_ground_h
#define talus_contact_ground_h

#include <talus/contact/obstacles.h>

#include <algorithm>
#include <vector>

namespace talus
{
  /// Surface under the soil: the bottom face of the mesh and, above the bottom
  /// face, the surfaces of obstacles. y points up.
  ///
  /// An obstacle belongs to the ground if it extends below the bottom of the
  /// mesh, or crosses the whole mesh along each horizontal axis: a seabed, a
  /// mound, a wall. Other obstacles, a pipeline for example, are bodies in or
  /// on the soil. Valid for the current positions of the obstacles: construct a
  /// Ground for each use.
  template <int dim>
  class Ground
  {
  public:
    /// @param domain region of the mesh
    /// @param obstacles may be null; must outlive the Ground
    explicit Ground(const Box<dim>       &domain,
                    const Obstacles<dim> *obstacles = nullptr);

    /// Whether the bottom face is the whole ground: no obstacles exist.
    bool
    is_bottom_face() const
    {
      return obstacles_ == nullptr;
    }

    /// Whether obstacle @p k belongs to the ground.
    bool
    contains(const unsigned int k) const
    {
      return std::binary_search(members_.begin(), members_.end(), k);
    }

    /// Whether @p x is outside of all obstacles, also of obstacles which do not
    /// belong to the ground.
    bool
    is_open(const dealii::Point<dim> &x) const
    {
      // A place on the surface is inside, despite round-off.
      const double round_off = 1e-12 * domain_.lower.distance(domain_.upper);
      return is_bottom_face() ||
             obstacles_->signed_distance(x, obstacles_->near(x, round_off)) >
               round_off;
    }

    /// Whether @p x is inside the ground or on its surface. Costs less than
    /// elevation().
    bool
    encloses(const dealii::Point<dim> &x) const;

    /// Return y of the ground below @p x, m; if @p x is inside the ground, y of
    /// the surface above @p x.
    double
    elevation(const dealii::Point<dim> &x) const;

    /// Vertical component of the unit normal of a surface of 80 degrees.
    /// Steeper surfaces are walls: no soil lies on them.
    static constexpr double min_vertical = 0.17364817766693033;

    /// Return the upward unit normal of the layers of soil at @p x: the normal
    /// of the ground below @p x, without walls.
    dealii::Tensor<1, dim>
    layer_normal(const dealii::Point<dim> &x) const;

  private:
    using Members = std::vector<unsigned int>;

    /// Members of the ground whose bounding boxes the vertical line through
    /// @p x meets: no other one can be the ground below or above it.
    Members
    members_in_column(const dealii::Point<dim> &x) const;

    static bool
    belongs_to_ground(const Obstacle<dim> &obstacle, const Box<dim> &domain);
    double
    surface_at(const Members            &members,
               const dealii::Point<dim> &x,
               double                    y_open,
               double                    y_inside) const;
    double
    elevation(const Members &members, const dealii::Point<dim> &x) const;

    Box<dim>              domain_;
    const Obstacles<dim> *obstacles_;
    Members               members_; ///< numbers of the obstacles of the ground
    BoxIndex<dim>         index_;   ///< index of the members in members_
  };
} // namespace talus

#endif

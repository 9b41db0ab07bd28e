// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_ground_h
#define talus_contact_ground_h

#include <talus/contact/obstacles.h>

#include <algorithm>
#include <vector>

namespace talus
{
  /// What soil lies on: the bottom face of the mesh and, where obstacles lie
  /// over it, their surfaces. y points up.
  ///
  /// An obstacle belongs to the ground if it goes on below the bottom of the
  /// mesh, or along each horizontal axis from one end of the mesh to the other:
  /// a seabed, a mound, a wall. Others, as a pipeline, are bodies in the soil
  /// or on it. For the obstacles where they are now; to be made anew where it
  /// is needed.
  template <int dim>
  class Ground
  {
  public:
    /// In a mesh that fills @p domain; @p obstacles must outlive it, null
    /// stands for none.
    explicit Ground(const Box<dim>       &domain,
                    const Obstacles<dim> *obstacles = nullptr);

    /// Whether there are no obstacles.
    bool
    is_bottom_face() const
    {
      return obstacles_ == nullptr;
    }

    /// Whether obstacle @p k belongs to it.
    bool
    contains(const unsigned int k) const
    {
      return std::binary_search(members_.begin(), members_.end(), k);
    }

    /// Whether soil can be at @p x: outside of all obstacles, those that do not
    /// belong to the ground, too.
    bool
    is_open(const dealii::Point<dim> &x) const
    {
      // A place on the surface is inside, whatever its last digits.
      const double round_off = 1e-12 * domain_.lower.distance(domain_.upper);
      return is_bottom_face() ||
             obstacles_->signed_distance(x, obstacles_->near(x, round_off)) >
               round_off;
    }

    /// y of the ground below @p x, m; of its surface above @p x if that lies
    /// inside of it.
    double
    elevation(const dealii::Point<dim> &x) const;

    /// Unit vector upwards across the layers of soil at @p x: the normal of the
    /// ground below, but of walls, which are steeper than 45 degrees, that of
    /// what there would be below without them.
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
    Members               members_; ///< numbers of those that belong to it
    BoxIndex<dim>         index_;   ///< of the members, by their place there
  };
} // namespace talus

#endif

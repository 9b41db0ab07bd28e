// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_contact_face_nodes_h
#define talus_contact_face_nodes_h

#include <talus/boundaries/boundaries.h>
#include <talus/surface/place_table.h>

#include <functional>
#include <vector>

namespace talus
{
  /// Node on a seabed face of the mesh: a place of contact with one node.
  template <int dim>
  struct FaceNode
  {
    unsigned int       node;
    unsigned int       face;
    PlaceKey           key;
    dealii::Point<dim> x;    ///< m
    double             area; ///< area of the face around the node, m^(dim-1)
    double volume; ///< volume of the cells at the face around the node, m^dim
    double maximum_shear_stress; ///< stress of the intact seabed, Pa
    unsigned char walls;         ///< components held by walls, bit d for axis d

    /// Unit vector from the face into the mesh.
    dealii::Tensor<1, dim>
    normal() const
    {
      dealii::Tensor<1, dim> result;
      result[face / 2] = (face % 2 == 0 ? 1. : -1.);
      return result;
    }

    /// Mean size of the cells at the face around the node, m.
    double
    cell_size() const
    {
      return 2. * volume / area;
    }
  };



  /// Owned nodes of the seabed faces, sorted by node, then by face.
  template <int dim>
  class FaceNodes
  {
  public:
    explicit FaceNodes(const Boundaries<dim> &boundaries)
      : boundaries_(boundaries)
    {}

    /// Call after each change of the mesh or its partition, after
    /// Boundaries::prepare().
    void
    prepare(const Grid<dim> &grid);

    const std::vector<FaceNode<dim>> &
    all() const
    {
      return nodes_;
    }

    const FaceNode<dim> &
    operator[](const unsigned int i) const
    {
      return nodes_[i];
    }

    unsigned int
    size() const
    {
      return nodes_.size();
    }

    /// Call action(i) for the entries of all() at an owned node.
    template <typename Action>
    void
    for_each_at(const unsigned int node, const Action &action) const
    {
      for (unsigned int i = first_[node];
           i < nodes_.size() && nodes_[i].node == node;
           ++i)
        action(i);
    }

    const Seabed<dim> &
    bed() const
    {
      return boundaries_.seabed();
    }

    /// Share of the maximum shear stress [-] that a rule beyond slip and
    /// trigger leaves at a node of a face. Until set_share_left(): 1.
    using ShareLeft = std::function<double(const FaceNode<dim> &)>;

    void
    set_share_left(const ShareLeft &share_left)
    {
      share_left_ = share_left;
    }

    /// Maximum shear stress at entry @p i of all() before slip and trigger, Pa.
    double
    maximum_shear_stress(const unsigned int i) const
    {
      const double share = share_left_ ? share_left_(nodes_[i]) : 1.;
      return share * nodes_[i].maximum_shear_stress;
    }

  private:
    const Boundaries<dim>     &boundaries_;
    std::vector<FaceNode<dim>> nodes_;
    std::vector<unsigned int>  first_; ///< in nodes_, by owned node
    ShareLeft                  share_left_;
  };
} // namespace talus

#endif

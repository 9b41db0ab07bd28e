// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_normal_force_memory_h
#define talus_boundaries_normal_force_memory_h

#include <talus/base/state_list.h>
#include <talus/grid/grid.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Running means of the normal forces at the nodes of seabed faces, for the
  /// limit of friction (InterfaceFriction). A mean belongs to the place of the
  /// node: it survives changes of the mesh and its partition, and checkpoints.
  template <int dim>
  class NormalForceMemory
  {
  public:
    /// List the nodes of @p faces (bit f for face f of the mesh). Call after
    /// each change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid, unsigned char faces);

    /// Begin a step. A mean without update() in a step is dropped.
    void
    begin_step();

    /// Number of the mean of @p node on @p face.
    unsigned int
    number(const unsigned int face, const unsigned int node) const
    {
      return index_[face].at(node);
    }

    /// Update mean @p number by the normal force of the step, @p force, N, with
    /// @p weight [-], and return the mean, N. After a step without update(), or
    /// in the first step, the mean is @p force.
    double
    update(unsigned int number, double force, double weight);

    /// Call action(key, face, node) for all means, in the order of number().
    template <typename Action>
    void
    for_each_node(const Action &action) const
    {
      for (const Mean &mean : means_)
        action(mean.key, mean.face, mean.node);
    }

    void
    list_state(StateList &list);

  private:
    struct Mean
    {
      unsigned long key;  ///< place of the node
      unsigned int  face; ///< face of the mesh
      unsigned int  node;
      double        force = 0; ///< N
      unsigned long step  = 0; ///< last update(); 0: none
    };

    std::vector<double>
    rows() const;
    void
    take(const std::vector<double> &rows);

    static constexpr unsigned int n_columns = 4;

    std::vector<Mean> means_;
    std::array<std::unordered_map<unsigned int, unsigned int>, 2 * dim>
                  index_; ///< number of the mean of a node, by face
    unsigned long step_ = 1;
    std::vector<double>
      restored_; ///< rows of a checkpoint, until they are taken
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_normal_force_memory_h
#define talus_boundaries_normal_force_memory_h

#include <talus/base/state.h>
#include <talus/grid/grid.h>

#include <array>
#include <unordered_map>
#include <vector>

namespace talus
{
  /// Running means of the normal forces at the nodes of the faces that are a
  /// seabed, which limit friction there (InterfaceFriction). A mean belongs to
  /// the place of its node: it survives changes of the mesh and its partition,
  /// and checkpoints.
  template <int dim>
  class NormalForceMemory
  {
  public:
    /// List the nodes of @p faces (bit f for face f of the mesh), after each
    /// change of the mesh or its partition. Collective.
    void
    prepare(const Grid<dim> &grid, unsigned char faces);

    /// Begin a step. Nodes without a force in a step are forgotten in the next.
    void
    begin_step();

    /// Add the normal force of this step, N, to the mean at @p node on @p face,
    /// with @p weight [-], and return the mean, N. The first force after a step
    /// without one is the mean.
    double
    update(unsigned int face, unsigned int node, double force, double weight);

    void
    list_state(StateList &list);

  private:
    struct Mean
    {
      unsigned long key;       ///< of the place of the node
      unsigned int  face;      ///< of the mesh
      double        force = 0; ///< N
      unsigned long step  = 0; ///< of the last force; 0: none yet
    };

    std::vector<double>
    rows() const;
    void
    take(const std::vector<double> &rows);

    static constexpr unsigned int n_columns = 4;

    std::vector<Mean> means_;
    std::array<std::unordered_map<unsigned int, unsigned int>, 2 * dim>
                  index_; ///< of a node among the means, by face
    unsigned long step_ = 1;
    std::vector<double>
      restored_; ///< rows of a checkpoint, until they are taken
  };
} // namespace talus

#endif

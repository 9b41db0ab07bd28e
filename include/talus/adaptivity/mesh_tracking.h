// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_mesh_tracking_h
#define talus_adaptivity_mesh_tracking_h

#include <talus/grid/grid.h>

#include <deal.II/base/parameter_acceptor.h>

#include <unordered_set>
#include <vector>

namespace talus
{
  /// Adapts the mesh to the soil: cells of size h at the points and around,
  /// larger cells far away.
  ///
  /// The mesh changes before any point can touch a node of a larger cell, so
  /// the points see a uniform mesh at all times.
  template <int dim>
  class MeshTracking : public dealii::ParameterAcceptor
  {
  public:
    MeshTracking();

    bool
    is_enabled() const
    {
      return enabled_;
    }

    /// Return whether a point of this rank may soon touch a larger cell.
    bool
    is_urgent(const Grid<dim>                 &grid,
              const std::vector<unsigned int> &occupied_cells) const;

    /// Return whether to look after @p step steps for cells that the soil has
    /// left.
    bool
    is_due(unsigned long step) const
    {
      return interval_ > 0 && step % interval_ == 0;
    }

    /// Adapt the mesh before points are created: cells of size h in and around
    /// @p boxes, which contain the bodies. Collective.
    void
    adapt(Grid<dim> &grid, const std::vector<Box<dim>> &boxes);

    /// Adapt the mesh to the points: cells of size h around the cells occupied
    /// on any rank. If the mesh changed, Grid::prepare() must follow.
    /// Collective.
    /// @param grid mesh
    /// @param occupied_cells cells with points of this rank
    /// @param is_urgent whether soil needs new small cells on any rank; if not,
    ///   the mesh changes only if a tenth of the small cells is not needed
    /// @return Whether the mesh changed.
    bool
    adapt(Grid<dim>                       &grid,
          const std::vector<unsigned int> &occupied_cells,
          bool                             is_urgent);

  private:
    using Lattice = typename Grid<dim>::Lattice;
    /// Keys of the blocks of lattice cells that must consist of cells of size
    /// h.
    using Blocks = std::unordered_set<unsigned long>;

    void
    want(const Grid<dim> &grid,
         const Lattice   &first,
         const Lattice   &last,
         Blocks          &wanted) const;

    bool         enabled_  = false;
    unsigned int margin_   = 16;
    unsigned int interval_ = 500;
  };
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_mesh_tracking_h
#define talus_adaptivity_mesh_tracking_h

#include <talus/grid/grid.h>

#include <deal.II/base/parameter_acceptor.h>

#include <unordered_set>
#include <vector>

namespace talus
{
  /// Lets the mesh follow the soil: cells of size h where there are points and
  /// around them, larger ones far away.
  ///
  /// The mesh changes before a point can touch a node of a larger cell, so that
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

    /// Whether a point of this rank may touch a larger cell.
    bool
    is_urgent(const Grid<dim>                 &grid,
              const std::vector<unsigned int> &occupied_cells) const;

    /// Whether the mesh is to be looked at after @p step steps, so that cells
    /// which the soil has left become larger.
    bool
    is_due(unsigned long step) const
    {
      return interval_ > 0 && step % interval_ == 0;
    }

    /// Change the mesh of the bodies to be: cells of size h in and around these
    /// boxes. Collective.
    void
    adapt(Grid<dim> &grid, const std::vector<Box<dim>> &boxes);

    /// Change the mesh of the soil: cells of size h around the cells occupied on
    /// any rank. Returns whether the mesh changed; Grid::prepare() must follow.
    /// Collective.
    bool
    adapt(Grid<dim> &grid, const std::vector<unsigned int> &occupied_cells);

  private:
    using Lattice = typename Grid<dim>::Lattice;
    /// Keys of what is to consist of cells of size h.
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

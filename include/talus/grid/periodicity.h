// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_grid_periodicity_h
#define talus_grid_periodicity_h

#include <talus/base/box.h>
#include <talus/grid/lattice.h>

#include <deal.II/base/types.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/dofs/dof_handler.h>

#include <array>
#include <cmath>
#include <map>

namespace talus
{
  /// Periodic axes of a uniform mesh: a point that leaves through the upper
  /// face enters through the lower face, and the nodes of both faces are
  /// identical.
  template <int dim>
  class Periodicity
  {
  public:
    /// Mesh without periodic axes.
    Periodicity() = default;

    Periodicity(const std::array<bool, dim> &axes, const Box<dim> &domain);

    bool
    along(const unsigned int d) const
    {
      return axes_[d];
    }

    bool
    any() const
    {
      return any_;
    }

    /// Distance by which @p coordinate along axis @p d lies beyond the mesh, in
    /// whole lengths of the mesh, m: coordinate minus shift lies in the mesh.
    /// Zero if the axis is not periodic or the coordinate is not finite.
    double
    shift(const unsigned int d, const double coordinate) const
    {
      if (!axes_[d])
        return 0.;
      const double n = std::floor((coordinate - domain_.lower[d]) / length_[d]);
      return std::isfinite(n) ? n * length_[d] : 0.;
    }

    /// Move a lattice position beyond a lattice of @p extent cells into the
    /// lattice along the periodic axes.
    void
    wrap(Lattice<dim> &place, const Lattice<dim> &extent) const;

    /// Make cells neighbours across the periodic faces of a mesh of coarse
    /// cells whose faces have the boundary ids of deal.II.
    void
    join_faces(
      dealii::parallel::distributed::Triangulation<dim> &triangulation) const;

    /// Return the twin on the lower faces of each node on upper periodic faces,
    /// if this rank knows both. Cells have edges of @p size, m. The owner of a
    /// node always knows the twin.
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
    find_twins(const dealii::DoFHandler<dim> &dof_handler, double size) const;

  private:
    std::array<bool, dim>   axes_{};
    bool                    any_ = false;
    Box<dim>                domain_;
    std::array<double, dim> length_{}; ///< m
  };
} // namespace talus

#endif

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
  /// Axes along which a uniform mesh repeats: what leaves it through the upper
  /// face enters through the lower one, and the nodes of the upper face are
  /// those of the lower one.
  template <int dim>
  class Periodicity
  {
  public:
    /// A mesh that does not repeat.
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

    /// How far @p coordinate along axis @p d lies beyond the mesh, in whole
    /// lengths of it, m: subtracted, it lies in the mesh. Zero along an axis
    /// that is not periodic, and where the coordinate is not finite.
    double
    shift(const unsigned int d, const double coordinate) const
    {
      if (!axes_[d])
        return 0.;
      const double n = std::floor((coordinate - domain_.lower[d]) / length_[d]);
      return std::isfinite(n) ? n * length_[d] : 0.;
    }

    /// Move a place beyond a lattice of @p extent cells into it along the
    /// periodic axes.
    void
    wrap(Lattice<dim> &place, const Lattice<dim> &extent) const;

    /// Make cells neighbours across the periodic faces of a mesh of coarse
    /// cells whose faces have deal.II's boundary ids.
    void
    join_faces(
      dealii::parallel::distributed::Triangulation<dim> &triangulation) const;

    /// For each node on upper periodic faces whose twin on the lower ones this
    /// rank knows, too: that twin. Cells have edges of @p size, m. The owner of
    /// a node knows its twin.
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

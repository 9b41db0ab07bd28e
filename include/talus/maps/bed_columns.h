// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_maps_bed_columns_h
#define talus_maps_bed_columns_h

#include <talus/maps/plan_columns.h>
#include <talus/problem/problem.h>
#include <talus/state/state.h>

#include <vector>

namespace talus
{
  /// Slip of soil over the bed, and share of the maximum shear stress left, in
  /// plan: means over the places of the bed in a column, weighted by area. The
  /// bed is the ground (see Ground): a seabed at the bottom of the mesh, and
  /// obstacles.
  template <int dim>
  class BedColumns
  {
  public:
    /// Sum over the places of all ranks; complete on the first rank.
    /// Collective.
    void
    sum(const State<dim>       &state,
        const Problem<dim>     &problem,
        const PlanColumns<dim> &columns);

    /// Whether slip or a region of the trigger changes a bed.
    bool
    is_used() const
    {
      return !area_.empty();
    }

    /// Mean slip in a column, m; not a number without a bed.
    double
    slip(const unsigned int column) const
    {
      return slip_[column] / area_[column];
    }

    /// Mean share of the maximum shear stress left in a column [-]; not a
    /// number without a bed.
    double
    share_left(const unsigned int column) const
    {
      return share_[column] / area_[column];
    }

  private:
    void
    add(const BedPlace<dim>    &place,
        double                  share_left,
        double                  h,
        const PlanColumns<dim> &columns);

    // Integrals over the bed by column
    std::vector<double> area_;  ///< m^(dim-1)
    std::vector<double> slip_;  ///< m m^(dim-1)
    std::vector<double> share_; ///< m^(dim-1)

    // Scratch data
    Footprints<dim> footprint_;
    ColumnShares    shares_;
  };
} // namespace talus

#endif

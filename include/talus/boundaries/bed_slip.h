// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_bed_slip_h
#define talus_boundaries_bed_slip_h

#include <talus/boundaries/interface_friction.h>
#include <talus/surface/place_table.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <tuple>
#include <vector>

namespace talus
{
  /// Place of a bed with the slip of soil over the place.
  template <int dim>
  struct BedPlace
  {
    PlaceKey           key;
    dealii::Point<dim> x;            ///< node, or centroid of the facet, m
    double             area = 0;     ///< area of node or facet, m^(dim-1)
    double             slip = 0;     ///< slip so far, m
    bool is_triggered       = false; ///< whether in the region of the trigger

    /// Number of the surface in Problem::beds().
    unsigned int
    bed() const
    {
      return key[2];
    }

    SurfaceState
    state() const
    {
      return {slip, is_triggered};
    }

    // Row of a PlaceTable
    static constexpr unsigned int n_keys = 4;
    static constexpr const char  *columns =
      "key of the node or cell: upper and lower 32 bits; 0 for the seabed or 1 "
      "+ obstacle; face of the mesh or number of the facet in its cell; place "
      "[m]; area [m or m^2]; slip [m]";

    bool
    is_kept() const
    {
      return slip > 0;
    }

    auto
    values()
    {
      return std::tie(x, area, slip);
    }
  };



  /// Region of the bed where the trigger acts; empty: nowhere.
  template <int dim>
  using BedRegion = std::function<bool(const dealii::Point<dim> &)>;



  /// Slip of soil over the places of all beds: facets of obstacles and nodes of
  /// a seabed. The slip belongs to the place. It survives changes of the mesh
  /// and its partition, places without soil or without a node, and checkpoints.
  template <int dim>
  class BedSlip
  {
  public:
    /// Set the region of the trigger. Call before prepare().
    void
    set_region(const BedRegion<dim> &region)
    {
      region_ = region;
    }

    bool
    has_region() const
    {
      return bool(region_);
    }

    /// Replace the places known to this rank. Slip of a place that no rank
    /// knows any more stays with the rank that had it. Call after each change
    /// of the mesh or its partition. Collective.
    void
    prepare(std::vector<BedPlace<dim>> places, MPI_Comm communicator);

    /// Replace the places known to this rank, where no place changes its rank.
    void
    update(std::vector<BedPlace<dim>> places);

    /// Give slip of a checkpoint to the ranks of the places. Call before each
    /// step. Collective in the first step after restore().
    void
    begin_step(MPI_Comm communicator);

    /// State of place @p place of the last prepare() or update().
    SurfaceState
    state(const unsigned int place) const
    {
      return table_[place].state();
    }

    /// Add @p slip, m, to a place of the last prepare() or update().
    void
    add(const unsigned int place, const double slip)
    {
      table_[place].slip += slip;
    }

    /// Places of the last prepare() or update().
    const std::vector<BedPlace<dim>> &
    places() const
    {
      return table_.all();
    }

    /// Call action(place) for all places of this rank, also for places with
    /// slip but without a node.
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      for (const BedPlace<dim> &place : places())
        action(place);
      table_.for_each_elsewhere([&](const PlaceKey &key, BedPlace<dim> place) {
        place.key          = key;
        place.is_triggered = region_ && region_(place.x);
        action(place);
      });
    }

    /// Area of the places with slip, m^(dim-1), for each of @p n_beds beds.
    /// Collective.
    std::vector<double>
    slipped_areas(unsigned int n_beds, MPI_Comm communicator) const;

    /// Largest slip, m, for each of @p n_beds beds. Collective.
    std::vector<double>
    largest_slips(unsigned int n_beds, MPI_Comm communicator) const;

    /// Number of places of this rank in the region of the trigger.
    unsigned int
    n_triggered() const;

    /// Return a row for each place of this rank with slip.
    std::vector<double>
    rows() const
    {
      return table_.rows();
    }

    /// Replace all slip by @p rows, see rows().
    void
    restore(const std::vector<double> &rows);

    /// Add the table @p name to the state.
    void
    list_state(const std::string &name, StateList &list);

  private:
    void
    describe(std::vector<BedPlace<dim>> places);

    BedRegion<dim>            region_;
    PlaceTable<BedPlace<dim>> table_{/*outlives_places=*/true};
  };
} // namespace talus

#endif

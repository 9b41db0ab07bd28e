// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_bed_slip_h
#define talus_boundaries_bed_slip_h

#include <talus/base/quantity.h>
#include <talus/base/state_list.h>
#include <talus/boundaries/interface_friction.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace talus
{
  /// Identity of a place of a bed in tables, on any number of ranks: key of the
  /// node or cell (two numbers), face of the mesh or number of the obstacle,
  /// number of the facet in the cell or 0.
  using BedPlaceName = std::array<double, 4>;



  /// Place of a bed with the slip of soil over the place.
  template <int dim>
  struct BedPlace
  {
    BedPlaceName       name;
    dealii::Point<dim> x;        ///< node, or centroid of the facet, m
    double             area;     ///< area of node or facet, m^(dim-1)
    double             slip = 0; ///< slip so far, m
  };



  /// Region of the bed where the trigger acts; empty: nowhere.
  template <int dim>
  using BedRegion = std::function<bool(const dealii::Point<dim> &)>;



  /// Slip of soil over the places of a bed: nodes of a seabed, or facets of
  /// obstacles. The slip belongs to the place. It survives changes of the mesh
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
      return {places_[place].slip, bool(is_triggered_[place])};
    }

    /// Add @p slip, m, to a place of the last prepare() or update().
    void
    add(const unsigned int place, const double slip)
    {
      places_[place].slip += slip;
    }

    /// Places of the last prepare() or update().
    const std::vector<BedPlace<dim>> &
    places() const
    {
      return places_;
    }

    /// Call action(place, state) for all places of this rank, also for places
    /// with slip but without a node.
    template <typename Action>
    void
    for_each(const Action &action) const
    {
      for (unsigned int i = 0; i < places_.size(); ++i)
        action(places_[i], state(i));
      for (const auto &[name, place] : elsewhere_)
        action(place, SurfaceState{place.slip, region_ && region_(place.x)});
    }

    /// Area of the places of this rank with slip, m^(dim-1).
    double
    slipped_area() const;

    /// Largest slip of this rank, m.
    double
    largest_slip() const;

    /// Number of places of this rank in the region of the trigger.
    unsigned int
    n_triggered() const;

    /// Return a row for each place of this rank with slip: name, place, area,
    /// slip.
    std::vector<double>
    rows() const;

    /// Replace all slip by @p rows, see rows().
    void
    restore(const std::vector<double> &rows);

    /// Add the table @p name to the state.
    void
    list_state(const std::string &name, StateList &list);

  private:
    static constexpr unsigned int n_columns = 4 + dim + 2;

    using Slips = std::map<BedPlaceName, BedPlace<dim>>;

    static void
    insert(const std::vector<double> &rows, Slips &slips);
    void
    assign(Slips &slips);

    BedRegion<dim>             region_;
    std::vector<BedPlace<dim>> places_;
    std::vector<bool>          is_triggered_;        ///< by place
    Slips                      elsewhere_;           ///< places without a node
    bool                       is_restored_ = false; ///< see begin_step()
  };



  /// Append slipped area, m^(dim-1), and largest slip, m, of all ranks over
  /// @p surfaces. Collective.
  template <int dim>
  void
  append_slip(const std::string  &surfaces,
              const BedSlip<dim> &slip,
              MPI_Comm            communicator,
              Quantities         &list);
} // namespace talus

#endif

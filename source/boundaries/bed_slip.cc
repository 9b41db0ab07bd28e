// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/bed_slip.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  /// Add the places of @p rows to @p slips. Slip never decreases: of two rows
  /// of a place the larger slip is right.
  template <int dim>
  void
  BedSlip<dim>::insert(const std::vector<double> &rows, Slips &slips)
  {
    for (std::size_t r = 0; r < rows.size(); r += n_columns)
      {
        BedPlace<dim> place;
        const double *value = &rows[r];
        std::copy_n(value, place.name.size(), place.name.begin());
        value += place.name.size();
        for (unsigned int d = 0; d < dim; ++d)
          place.x[d] = *value++;
        place.area           = *value++;
        place.slip           = *value++;
        BedPlace<dim> &known = slips.emplace(place.name, place).first->second;
        known.slip           = std::max(known.slip, place.slip);
      }
  }



  /// Move the slip of the places of this rank from @p slips to the places.
  template <int dim>
  void
  BedSlip<dim>::assign(Slips &slips)
  {
    for (BedPlace<dim> &place : places_)
      {
        const auto found = slips.find(place.name);
        place.slip       = (found == slips.end() ? 0. : found->second.slip);
        if (found != slips.end())
          slips.erase(found);
      }
  }



  // There are only as many rows as places with slip, and the mesh changes
  // seldom. All ranks have the same list of slips in the same order.
  template <int dim>
  void
  BedSlip<dim>::prepare(std::vector<BedPlace<dim>> places,
                        const MPI_Comm             communicator)
  {
    Slips                                slips;
    std::map<BedPlaceName, unsigned int> holder; // first rank with a row
    const auto all_rows = Utilities::MPI::all_gather(communicator, rows());
    for (unsigned int rank = 0; rank < all_rows.size(); ++rank)
      {
        Slips of_rank;
        insert(all_rows[rank], of_rank);
        insert(all_rows[rank], slips);
        for (const auto &entry : of_rank)
          holder.emplace(entry.first, rank);
      }
    update(std::move(places));
    const Slips all = slips;
    assign(slips);
    std::vector<unsigned int> is_known;
    for (const auto &entry : all)
      is_known.push_back(slips.count(entry.first) == 0);
    // Zero elements are no valid message.
    if (!all.empty())
      Utilities::MPI::max(is_known, communicator, is_known);
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    elsewhere_.clear();
    auto known = is_known.begin();
    for (const auto &entry : all)
      if (!*known++ && holder[entry.first] == rank)
        elsewhere_.insert(entry);
    is_restored_ = false;
  }



  template <int dim>
  void
  BedSlip<dim>::update(std::vector<BedPlace<dim>> places)
  {
    Slips slips;
    insert(rows(), slips);
    places_ = std::move(places);
    is_triggered_.assign(places_.size(), false);
    if (has_region())
      for (unsigned int i = 0; i < places_.size(); ++i)
        is_triggered_[i] = region_(places_[i].x);
    assign(slips);
    elsewhere_ = std::move(slips);
  }



  template <int dim>
  void
  BedSlip<dim>::begin_step(const MPI_Comm communicator)
  {
    if (is_restored_)
      prepare(places_, communicator);
  }



  template <int dim>
  double
  BedSlip<dim>::slipped_area() const
  {
    double area = 0;
    for_each([&area](const BedPlace<dim> &place, const SurfaceState &state) {
      area += (state.slip > 0 ? place.area : 0.);
    });
    return area;
  }



  template <int dim>
  double
  BedSlip<dim>::largest_slip() const
  {
    double slip = 0;
    for_each([&slip](const BedPlace<dim> &, const SurfaceState &state) {
      slip = std::max(slip, state.slip);
    });
    return slip;
  }



  template <int dim>
  unsigned int
  BedSlip<dim>::n_triggered() const
  {
    return std::count(is_triggered_.begin(), is_triggered_.end(), true);
  }



  template <int dim>
  std::vector<double>
  BedSlip<dim>::rows() const
  {
    std::vector<double> rows;
    for_each([&rows](const BedPlace<dim> &place, const SurfaceState &state) {
      if (!(state.slip > 0))
        return;
      rows.insert(rows.end(), place.name.begin(), place.name.end());
      for (unsigned int d = 0; d < dim; ++d)
        rows.push_back(place.x[d]);
      rows.insert(rows.end(), {place.area, state.slip});
    });
    return rows;
  }



  // A checkpoint gives all rows to each rank, which keeps the rows of unknown
  // places until begin_step().
  template <int dim>
  void
  BedSlip<dim>::restore(const std::vector<double> &rows)
  {
    elsewhere_.clear();
    insert(rows, elsewhere_);
    assign(elsewhere_);
    is_restored_ = true;
  }



  template <int dim>
  void
  BedSlip<dim>::list_state(const std::string &name, StateList &list)
  {
    list.add_table(
      {name,
       "key of the node or cell: upper and lower 32 bits; face or obstacle; "
       "number of the facet in its cell; place [m]; area [m or m^2]; slip [m]",
       n_columns,
       [this]() { return rows(); },
       [this](const std::vector<double> &rows) { restore(rows); }});
  }



  template <int dim>
  void
  append_slip(const std::string  &surfaces,
              const BedSlip<dim> &slip,
              const MPI_Comm      communicator,
              Quantities         &list)
  {
    list.push_back({"slipped " + surfaces,
                    dim == 2 ? "m" : "m^2",
                    Utilities::MPI::sum(slip.slipped_area(), communicator)});
    list.push_back({"largest slip of " + surfaces,
                    "m",
                    Utilities::MPI::max(slip.largest_slip(), communicator)});
  }



  template class BedSlip<2>;
  template class BedSlip<3>;

  template decltype(append_slip<2>) append_slip<2>;
  template decltype(append_slip<3>) append_slip<3>;
} // namespace talus

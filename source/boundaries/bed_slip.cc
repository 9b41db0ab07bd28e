// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/bed_slip.h>

#include <algorithm>

namespace talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::vector<PlaceKey>
    keys_of(const std::vector<BedPlace<dim>> &places)
    {
      std::vector<PlaceKey> keys;
      for (const BedPlace<dim> &place : places)
        keys.push_back(place.key);
      return keys;
    }
  } // namespace



  template <int dim>
  void
  BedSlip<dim>::prepare(std::vector<BedPlace<dim>> places,
                        const MPI_Comm             communicator)
  {
    table_.move_to(keys_of(places), communicator);
    describe(std::move(places));
  }



  template <int dim>
  void
  BedSlip<dim>::update(std::vector<BedPlace<dim>> places)
  {
    table_.update(keys_of(places));
    describe(std::move(places));
  }



  /// Set all but the slip of the places in the table to @p places.
  template <int dim>
  void
  BedSlip<dim>::describe(std::vector<BedPlace<dim>> places)
  {
    for (unsigned int i = 0; i < places.size(); ++i)
      {
        places[i].slip         = table_[i].slip;
        places[i].is_triggered = region_ && region_(places[i].x);
        table_[i]              = places[i];
      }
  }



  template <int dim>
  void
  BedSlip<dim>::begin_step(const MPI_Comm communicator)
  {
    if (table_.is_waiting())
      prepare(places(), communicator);
  }



  template <int dim>
  std::vector<double>
  BedSlip<dim>::slipped_areas(const unsigned int n_beds,
                              const MPI_Comm     communicator) const
  {
    std::vector<double> areas(n_beds, 0.);
    for_each([&areas](const BedPlace<dim> &place) {
      areas[place.bed()] += (place.slip > 0 ? place.area : 0.);
    });
    Utilities::MPI::sum(areas, communicator, areas);
    return areas;
  }



  template <int dim>
  std::vector<double>
  BedSlip<dim>::largest_slips(const unsigned int n_beds,
                              const MPI_Comm     communicator) const
  {
    std::vector<double> slips(n_beds, 0.);
    for_each([&slips](const BedPlace<dim> &place) {
      slips[place.bed()] = std::max(slips[place.bed()], place.slip);
    });
    Utilities::MPI::max(slips, communicator, slips);
    return slips;
  }



  template <int dim>
  unsigned int
  BedSlip<dim>::n_triggered() const
  {
    return std::count_if(places().begin(),
                         places().end(),
                         [](const BedPlace<dim> &place) {
                           return place.is_triggered;
                         });
  }



  template <int dim>
  void
  BedSlip<dim>::restore(const std::vector<double> &rows)
  {
    const std::vector<BedPlace<dim>> places = this->places();
    table_.restore(rows);
    describe(places);
  }



  template <int dim>
  void
  BedSlip<dim>::list_state(const std::string &name, StateList &list)
  {
    table_.list_state(
      name,
      list,
      []() { return true; },
      [this](const std::vector<double> &rows) { restore(rows); });
  }



  template class BedSlip<2>;
  template class BedSlip<3>;
} // namespace talus

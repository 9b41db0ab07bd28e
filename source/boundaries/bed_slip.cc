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
  double
  BedSlip<dim>::slipped_area() const
  {
    double area = 0;
    for_each([&area](const BedPlace<dim> &place) {
      area += (place.slip > 0 ? place.area : 0.);
    });
    return area;
  }



  template <int dim>
  double
  BedSlip<dim>::largest_slip() const
  {
    double slip = 0;
    for_each([&slip](const BedPlace<dim> &place) {
      slip = std::max(slip, place.slip);
    });
    return slip;
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

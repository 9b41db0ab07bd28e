// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/surface/place_table.h>

#include <set>

namespace talus
{
  using namespace dealii;

  /// Add @p rows of the rank @p rank to @p index. Several ranks may have a row
  /// of the same place after a checkpoint was read, since every rank reads all
  /// rows; the row of the first rank is kept.
  void
  PackedPlaceTable::add(const std::vector<double> &rows,
                        const unsigned int         rank,
                        Index                     &index) const
  {
    for_each_packed(rows, [&](const PlaceKey &place, const double *row) {
      index.emplace(place, Found{row, rank, 0});
    });
  }



  /// Replace the places, and set their rows from @p index.
  void
  PackedPlaceTable::assign(std::vector<PlaceKey> places, Index &index)
  {
    places_ = std::move(places);
    reset(size());
    for (unsigned int i = 0; i < size(); ++i)
      if (const auto found = index.find(places_[i]); found != index.end())
        {
          unpack(i, found->second.row + n_keys_);
          found->second.has_place = 1;
        }
    elsewhere_.clear();
  }



  // All ranks get all rows: there are only as many rows as places with soil,
  // and the mesh changes seldom.
  void
  PackedPlaceTable::move_to(std::vector<PlaceKey> places,
                            const MPI_Comm        communicator)
  {
    const auto all_rows = Utilities::MPI::all_gather(communicator, rows());
    Index      index;
    for (unsigned int rank = 0; rank < all_rows.size(); ++rank)
      add(all_rows[rank], rank, index);
    assign(std::move(places), index);
    is_waiting_ = false;
    // Zero elements are no valid message.
    if (!outlives_places_ || index.empty())
      return;
    std::vector<unsigned int> has_place;
    for (const auto &entry : index)
      has_place.push_back(entry.second.has_place);
    Utilities::MPI::max(has_place, communicator, has_place);
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    auto               has  = has_place.begin();
    for (const auto &entry : index)
      if (!*has++ && entry.second.rank == rank)
        keep(entry.second.row);
  }



  void
  PackedPlaceTable::move_to(
    const std::function<bool(const PlaceKey &)> &is_owned,
    const MPI_Comm                               communicator)
  {
    std::vector<double> all;
    for (const auto &of_rank : Utilities::MPI::all_gather(communicator, rows()))
      all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::set<PlaceKey>    seen;
    std::vector<PlaceKey> places;
    for_each_packed(all, [&](const PlaceKey &place, const double *) {
      if (seen.insert(place).second && is_owned(place))
        places.push_back(place);
    });
    restore(all);
    update(std::move(places));
  }



  // Rows that outlive their places may belong to another rank.
  void
  PackedPlaceTable::update(std::vector<PlaceKey> places)
  {
    const bool is_waiting = is_waiting_ && outlives_places_;
    move_to(std::move(places), MPI_COMM_SELF);
    is_waiting_ = is_waiting;
  }



  std::vector<double>
  PackedPlaceTable::rows() const
  {
    std::vector<double> rows;
    for (unsigned int i = 0; i < size(); ++i)
      if (is_kept(i))
        {
          rows.insert(rows.end(),
                      places_[i].begin(),
                      places_[i].begin() + n_keys_);
          pack(i, rows);
        }
    rows.insert(rows.end(), elsewhere_.begin(), elsewhere_.end());
    return rows;
  }



  // The order of rows without a place is kept, for move_to() by is_owned().
  void
  PackedPlaceTable::restore(const std::vector<double> &rows)
  {
    Index index;
    add(rows, 0, index);
    assign(std::move(places_), index);
    for_each_packed(rows, [&](const PlaceKey &place, const double *row) {
      if (!index.at(place).has_place)
        keep(row);
    });
    is_waiting_ = true;
  }



  void
  PackedPlaceTable::list_state(const std::string           &name,
                               StateList                   &list,
                               const std::function<bool()> &is_needed,
                               const Restore               &restore)
  {
    list.add_table(
      {name,
       columns_,
       n_columns_,
       [this, is_needed]() {
         return is_needed() ? rows() : std::vector<double>();
       },
       restore
         ? restore
         : [this](const std::vector<double> &rows) { this->restore(rows); }});
  }
} // namespace talus

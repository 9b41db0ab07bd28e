// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_surface_place_table_h
#define talus_surface_place_table_h

#include <talus/base/key_halves.h>
#include <talus/base/state_list.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace talus
{
  /// Identity of a place of a surface, on any number of ranks: key of the node
  /// or cell, upper and lower 32 bits; face of the mesh or number of the
  /// obstacle; number in the cell.
  using PlaceKey = std::array<double, 4>;

  inline PlaceKey
  place_key(const unsigned long key,
            const unsigned int  surface = 0,
            const double        number  = 0)
  {
    const auto [upper, lower] = halves_of_key(key);
    return {{upper, lower, double(surface), number}};
  }



  /// Part of PlaceTable that does not depend on the type of the rows. A row of
  /// a checkpoint consists of the first columns of the PlaceKey, followed by
  /// the numbers of the row.
  class PackedPlaceTable
  {
  public:
    virtual ~PackedPlaceTable() = default;

    /// Return the places of this rank, one per row of the table.
    const std::vector<PlaceKey> &
    places() const
    {
      return places_;
    }

    unsigned int
    size() const
    {
      return places_.size();
    }

    /// Replace the places of this rank. The row of a place follows the place to
    /// the rank that has the place now. A new place has a default row.
    /// Collective.
    void
    move_to(std::vector<PlaceKey> places, MPI_Comm communicator);

    /// Replace the places of this rank by the places @p is_owned(place) among
    /// all places with a row on any rank, in the order of the rows. Collective.
    void
    move_to(const std::function<bool(const PlaceKey &)> &is_owned,
            MPI_Comm                                     communicator);

    /// Replace the places of this rank, where no place changes its rank.
    void
    update(std::vector<PlaceKey> places);

    /// Return the rows worth keeping, including restored rows without a place.
    std::vector<double>
    rows() const;

    /// Replace all rows by @p rows of this rank or of all ranks, see rows().
    /// Rows without a place on this rank wait for move_to() or update().
    void
    restore(const std::vector<double> &rows);

    /// Whether move_to() or update() must follow restore(). Identical on all
    /// ranks.
    bool
    is_waiting() const
    {
      return is_waiting_;
    }

    using Restore = std::function<void(const std::vector<double> &rows)>;

    /// Add the table @p name to the state. Without @p is_needed the table is
    /// empty. The owner of a table with more than the rows gives a function
    /// @p restore that calls restore() and adds the rest.
    void
    list_state(
      const std::string           &name,
      StateList                   &list,
      const std::function<bool()> &is_needed = []() { return true; },
      const Restore               &restore   = {});

  protected:
    /// @param columns names and units of the columns of rows()
    /// @param n_keys number of columns with the PlaceKey
    /// @param n_values number of columns with the numbers of a row
    /// @param outlives_places whether a row without a place on any rank is
    ///   kept, by the rank that had the row
    PackedPlaceTable(const char  *columns,
                     unsigned int n_keys,
                     unsigned int n_values,
                     bool         outlives_places)
      : columns_(columns)
      , n_keys_(n_keys)
      , n_columns_(n_keys + n_values)
      , outlives_places_(outlives_places)
    {}

    /// Make @p n default rows.
    virtual void
    reset(unsigned int n) = 0;
    virtual bool
    is_kept(unsigned int i) const = 0;
    /// Append the numbers of row @p i to @p rows.
    virtual void
    pack(unsigned int i, std::vector<double> &rows) const = 0;
    /// Set row @p i from its numbers.
    virtual void
    unpack(unsigned int i, const double *values) = 0;

    /// Call action(key, row) for each packed row of @p rows.
    template <typename Action>
    void
    for_each_packed(const std::vector<double> &rows, const Action &action) const
    {
      for (std::size_t r = 0; r < rows.size(); r += n_columns_)
        {
          PlaceKey key = {};
          std::copy_n(&rows[r], n_keys_, key.begin());
          action(key, &rows[r]);
        }
    }

    std::vector<PlaceKey> places_;
    std::vector<double>   elsewhere_; ///< packed rows without a place here
    bool                  is_waiting_ = false;

  private:
    struct Found
    {
      const double *row;
      unsigned int  rank;
      unsigned int  has_place; ///< 1: yes, 0: no
    };
    using Index = std::map<PlaceKey, Found>;

    void
    add(const std::vector<double> &rows, unsigned int rank, Index &index) const;
    void
    assign(std::vector<PlaceKey> places, Index &index);
    void
    keep(const double *row)
    {
      elsewhere_.insert(elsewhere_.end(), row, row + n_columns_);
    }

    const char  *columns_;
    unsigned int n_keys_, n_columns_;
    bool         outlives_places_;
  };



  /// Rows of type @p Row by place of a surface. A row belongs to the place: it
  /// survives changes of the mesh, of the partition and of the set of places,
  /// and checkpoints. Places are nodes or cells of the mesh, or parts of the
  /// surface in a cell. @p Row has
  ///
  ///   static constexpr const char  *columns;  // names and units, with the key
  ///   static constexpr unsigned int n_keys;   // columns with the key
  ///   bool is_kept() const;                   // false: as a default row
  ///   auto values();                          // std::tie() of what is saved
  template <typename Row>
  class PlaceTable : public PackedPlaceTable
  {
  public:
    explicit PlaceTable(const bool outlives_places = false)
      : PackedPlaceTable(Row::columns, Row::n_keys, n_values(), outlives_places)
    {}

    Row &
    operator[](const unsigned int i)
    {
      return rows_[i];
    }

    const Row &
    operator[](const unsigned int i) const
    {
      return rows_[i];
    }

    /// Return the rows of places().
    const std::vector<Row> &
    all() const
    {
      return rows_;
    }

    auto
    begin()
    {
      return rows_.begin();
    }

    auto
    end()
    {
      return rows_.end();
    }

    /// Call action(place, row) for all rows of this rank without a place.
    template <typename Action>
    void
    for_each_elsewhere(const Action &action) const
    {
      for_each_packed(elsewhere_,
                      [&](const PlaceKey &place, const double *packed) {
                        Row row = {};
                        set(packed + Row::n_keys, row);
                        action(place, row);
                      });
    }

    void
    clear()
    {
      places_.clear();
      rows_.clear();
      elsewhere_.clear();
      is_waiting_ = false;
    }

    void
    push_back(const PlaceKey &place, const Row &row)
    {
      places_.push_back(place);
      rows_.push_back(row);
    }

  private:
    /// Call action(x) for all numbers of @p row.
    template <typename Action>
    static void
    for_each_number(Row &row, const Action &action)
    {
      const auto visit = [&action](auto &value) {
        using Value = std::decay_t<decltype(value)>;
        if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>)
          action(value);
        else
          for (unsigned int d = 0; d < Value::dimension; ++d)
            action(value[d]);
      };
      std::apply([&](auto &...values) { (visit(values), ...); }, row.values());
    }

    static unsigned int
    n_values()
    {
      unsigned int n   = 0;
      Row          row = {};
      for_each_number(row, [&n](const auto &) { ++n; });
      return n;
    }

    static void
    set(const double *values, Row &row)
    {
      for_each_number(row, [&values](auto &x) {
        x = static_cast<std::decay_t<decltype(x)>>(*values++);
      });
    }

    void
    reset(const unsigned int n) override
    {
      rows_.assign(n, Row());
    }

    bool
    is_kept(const unsigned int i) const override
    {
      return rows_[i].is_kept();
    }

    void
    pack(const unsigned int i, std::vector<double> &values) const override
    {
      Row row = rows_[i];
      for_each_number(row, [&values](const auto &x) {
        values.push_back(static_cast<double>(x));
      });
    }

    void
    unpack(const unsigned int i, const double *values) override
    {
      set(values, rows_[i]);
    }

    std::vector<Row> rows_;
  };
} // namespace talus

#endif

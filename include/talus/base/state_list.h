// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_state_list_h
#define talus_base_state_list_h

#include <talus/base/errors.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace talus
{
  /// Relation between the values of a number on different ranks; determines the
  /// values after a restart on another number of ranks.
  enum class Reduction
  {
    sum,     ///< each rank has a part; the first rank gets the sum
    maximum, ///< every rank gets the maximum
    equal    ///< identical on every rank
  };



  /// State of a run besides points and mesh: named numbers, texts and tables,
  /// with functions that get and set them. Each class with state adds it in
  /// `list_state(StateList &)`; checkpoints loop over the list without
  /// knowledge of the meaning. Variables in the list must outlive the list.
  class StateList
  {
  public:
    struct Number
    {
      std::string                 name; ///< without slashes
      std::string                 unit;
      Reduction                   reduction;
      std::function<double()>     get;
      std::function<void(double)> set;
    };

    /// Text that is identical on all ranks, or known to the first rank only.
    /// The text of the first rank is saved, and all ranks get it back.
    struct Text
    {
      std::string                              name;
      std::function<std::string()>             get;
      std::function<void(const std::string &)> set;
    };

    /// Table distributed over the ranks by rows.
    struct Table
    {
      std::string                                      name;
      std::string                                      columns; ///< with units
      unsigned int                                     n_columns;
      std::function<std::vector<double>()>             get; ///< local rows
      std::function<void(const std::vector<double> &)> set; ///< all rows
      /// Whether all ranks have the same rows: the rows of the first rank are
      /// saved.
      bool is_common = false;
    };

    /// Add a number. Integers up to 2^53 are exact as doubles.
    template <typename Value>
    void
    add(const std::string &name,
        const std::string &unit,
        Value             &value,
        const Reduction    reduction)
    {
      numbers_.push_back({name,
                          unit,
                          reduction,
                          [&value]() { return static_cast<double>(value); },
                          [&value, name](const double saved) {
                            check_that_it_fits<Value>(name, saved);
                            value = static_cast<Value>(saved);
                          }});
    }

    /// Add an array or a vector, component by component.
    template <typename Array>
    void
    add_components(const std::string &name,
                   const std::string &unit,
                   Array             &values,
                   const unsigned int n_components,
                   const Reduction    reduction)
    {
      for (unsigned int i = 0; i < n_components; ++i)
        add(name + " " + std::to_string(i), unit, values[i], reduction);
    }

    void
    add_text(const Text &text)
    {
      texts_.push_back(text);
    }

    void
    add_table(const Table &table)
    {
      tables_.push_back(table);
    }

    const std::vector<Table> &
    tables() const
    {
      return tables_;
    }

    const std::vector<Number> &
    numbers() const
    {
      return numbers_;
    }

    const std::vector<Text> &
    texts() const
    {
      return texts_;
    }

  private:
    /// Throw ExcUser if @p saved does not fit into an integer type.
    template <typename Value>
    static void
    check_that_it_fits(const std::string &name, const double saved)
    {
      if constexpr (std::is_integral_v<Value>)
        AssertThrow(saved >= double(std::numeric_limits<Value>::lowest()) &&
                      saved <=
                        std::min(9007199254740992.,
                                 double(std::numeric_limits<Value>::max())),
                    ExcUser(text("The state '",
                                 name,
                                 "' of a checkpoint is ",
                                 saved,
                                 "; expected a whole number. Remove the "
                                 "checkpoint, so that the previous one is "
                                 "used.")));
    }

    std::vector<Number> numbers_;
    std::vector<Text>   texts_;
    std::vector<Table>  tables_;
  };



  /// Return the value of rank @p rank out of @p n_ranks after a restart. With
  /// the same number of ranks each rank gets its own value.
  ///
  /// @param shares saved values of all ranks
  /// @param reduction relation between the values
  inline double
  restored_share(const std::vector<double> &shares,
                 const Reduction            reduction,
                 const unsigned int         rank,
                 const unsigned int         n_ranks)
  {
    if (shares.size() == n_ranks)
      return shares[rank];
    double total = 0, largest = shares[0];
    for (const double share : shares)
      {
        total += share;
        largest = (share > largest ? share : largest);
      }
    switch (reduction)
      {
        case Reduction::sum:
          return rank == 0 ? total : 0.;
        case Reduction::maximum:
          return largest;
        default:
          return shares[0];
      }
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_quantity_h
#define talus_base_quantity_h

#include <string>
#include <vector>

namespace talus
{
  /// A number for the whole run at one time, written to a table.
  struct Quantity
  {
    std::string name;
    std::string unit; ///< empty for a count
    double      value;

    /// Heading of the table column.
    std::string
    heading() const
    {
      return unit.empty() ? name : name + " [" + unit + "]";
    }
  };

  /// Ordered list of quantities: one row of a table.
  using Quantities = std::vector<Quantity>;



  /// Append a vector as one quantity per axis.
  template <int dim, typename Vector>
  void
  append_vector(Quantities        &list,
                const std::string &name,
                const std::string &unit,
                const Vector      &vector)
  {
    const std::string axes = "xyz";
    for (unsigned int d = 0; d < dim; ++d)
      list.push_back({name + ' ' + axes[d], unit, vector[d]});
  }
} // namespace talus

#endif

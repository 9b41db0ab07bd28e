// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_state_cells_h
#define talus_observers_state_cells_h

#include <talus/io/output_cells.h>
#include <talus/state/state.h>

namespace talus
{
  /// Return an empty set of output cells with the given @p fields, the time and
  /// step of @p state, and the precision required by the coordinates of the
  /// mesh.
  template <int dim>
  OutputCells
  state_cells(const State<dim>  &state,
              std::vector<Field> fields,
              const ItemsAt      items_at,
              const CellShape    shape)
  {
    return {std::move(fields),
            items_at,
            shape,
            state.time,
            state.step,
            places_need_double(state.grid.domain_before_growth(),
                               state.grid.cell_size())};
  }



  /// Return a field with one number per item, value(i).
  template <typename Function>
  Field
  scalar_field(const std::string &name,
               const std::string &unit,
               const Function    &value)
  {
    return {name,
            unit,
            FieldKind::scalar,
            [value](const unsigned int i, double *to) { *to = value(i); }};
  }



  /// Return a field with a vector per item: value(i)[d] for each axis d.
  template <int dim, typename Function>
  Field
  vector_field(const std::string &name,
               const std::string &unit,
               const Function    &value)
  {
    return {name,
            unit,
            FieldKind::vector,
            [value](const unsigned int i, double *to) {
              const auto vector = value(i);
              for (unsigned int d = 0; d < dim; ++d)
                to[d] = vector[d];
            }};
  }
} // namespace talus

#endif

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
} // namespace talus

#endif

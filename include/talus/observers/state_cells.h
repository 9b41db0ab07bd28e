// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_observers_state_cells_h
#define talus_observers_state_cells_h

#include <talus/io/output_cells.h>
#include <talus/state/state.h>

namespace talus
{
  /// For cells of this state, none yet: its time and step, and the precision
  /// that its mesh needs.
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

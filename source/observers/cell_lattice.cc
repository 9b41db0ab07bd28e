// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/observers/cell_lattice.h>

#include <talus/base/assertion.h>

#include <cmath>

namespace talus
{
  template <int dim>
  CellLattice<dim>::CellLattice(const Grid<dim> &grid)
    : lower_(grid.domain().lower)
    , size_(grid.cell_size())
  {
    // The mesh is a whole number of cells long; lround removes only the
    // round-off. The largest index must leave space for the spare value below
    // zero in a key.
    for (unsigned int d = 0; d < dim; ++d)
      {
        extent_[d] =
          static_cast<int>(std::lround(grid.domain().length(d) / size_));
        TalusAssert(extent_[d] < int(mask), dealii::ExcInternalError());
      }
  }



  template class CellLattice<2>;
  template class CellLattice<3>;
} // namespace talus

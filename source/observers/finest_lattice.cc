#include <talus/observers/finest_lattice.h>

#include <cmath>

namespace talus
{
  template <int dim>
  FinestLattice<dim>::FinestLattice(const Grid<dim> &grid)
    : lower_(grid.domain().lower)
    , size_(grid.finest_size())
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        extent_[d] =
          static_cast<int>(std::lround(grid.domain().length(d) / size_));
        Assert(extent_[d] < int(mask), dealii::ExcInternalError());
      }
  }



  template class FinestLattice<2>;
  template class FinestLattice<3>;
} // namespace talus

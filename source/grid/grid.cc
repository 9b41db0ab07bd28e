// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/grid/grid.h>

namespace talus
{
  template <int dim>
  Grid<dim>::Grid(MPI_Comm communicator)
    : Mesh<dim>(communicator)
    , NodeNumbering<dim>(static_cast<const Mesh<dim> &>(*this))
    , CellCache<dim>(static_cast<const Mesh<dim> &>(*this))
  {}



  // The tables of cells need node numbers, and messages between ranks need the
  // lists of owned and ghost nodes.
  template <int dim>
  void
  Grid<dim>::prepare()
  {
    this->prepare_nodes(*this);
    this->prepare_cells(*this);
    NodalExchange<dim> exchange;
    exchange.prepare(*this, 2);
    this->prepare_boundary(*this, *this, *this, exchange);
    this->find_larger_cells(*this, exchange);
  }



  template class Grid<2>;
  template class Grid<3>;
} // namespace talus

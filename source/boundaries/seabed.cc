// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/boundaries/seabed.h>

namespace talus
{
  template <int dim>
  Seabed<dim>::Seabed()
    : Bed<dim>("/Boundaries/Seabed",
               "1000",
               "Maximum shear stress tau_max that the seabed passes to the "
               "soil [Pa]: a number, or an expression in x, y (, z), the names "
               "of surfaces and depth, the depth of the place below the "
               "mudline at the start [m], 0 "
               "without soil above.")
  {
    this->add_parameter(
      "Gap",
      has_gap_,
      "Whether contact begins at the face: when the boxes of the points come "
      "nearer than a twentieth of a cell, so that a falling body stops at the "
      "face. Otherwise (as in the paper) contact begins as soon as a node on "
      "the face carries soil, up to a cell early.");
  }



  template class Seabed<2>;
  template class Seabed<3>;
} // namespace talus

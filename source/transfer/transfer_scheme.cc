// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/transfer/transfer_scheme.h>

namespace talus
{
  using namespace dealii;

  TransferScheme::TransferScheme()
    : ParameterAcceptor("/Transfer")
  {
    add_parameter("FLIP fraction",
                  flip_fraction_,
                  "Weight of FLIP (old velocity plus increment of the grid) in "
                  "the new velocity of a point [-]. The remaining weight is "
                  "given to PIC (velocity of the grid), which damps.",
                  this->prm,
                  Patterns::Double(0., 1.));
    add_parameter(
      "Scheme",
      name_,
      "Update of the velocities of the points. 'FLIP': points add the "
      "increments of the grid, and velocities that the grid cannot see stay "
      "for ever. 'filtered FLIP': in addition, at a fixed interval, XPIC "
      "removes the velocities that the grid cannot see, and where B-bar is on "
      "the mean stress of each point is replaced by the cell mean.",
      this->prm,
      Patterns::Selection("FLIP|filtered FLIP"));
    add_parameter("Filter interval",
                  filter_interval_,
                  "Number of steps between two filterings [-]. A smaller "
                  "number damps more; near 1/(CFL number) noise has no time to "
                  "grow in between.",
                  this->prm,
                  Patterns::Integer(1));
    add_parameter(
      "Filter order",
      filter_order_,
      "Number m of passes to the grid and back in XPIC(m) [-]. A larger number "
      "keeps more of the shortest waves; 1 is PIC.",
      this->prm,
      Patterns::Integer(1, 20));
  }
} // namespace talus

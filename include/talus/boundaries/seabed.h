// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_seabed_h
#define talus_boundaries_seabed_h

#include <talus/boundaries/bed.h>

namespace talus
{
  /// Parameters of the seabed, one surface on all faces of the mesh with the
  /// condition `seabed`. Contact applies the contact at the nodes.
  template <int dim>
  class Seabed : public Bed<dim>
  {
  public:
    Seabed();

    /// Whether contact begins when the boxes of points reach the face.
    /// Otherwise contact begins as soon as a node on the face carries soil, up
    /// to a cell above the face.
    bool
    has_gap() const
    {
      return has_gap_;
    }

  private:
    bool has_gap_ = true;
  };
} // namespace talus

#endif

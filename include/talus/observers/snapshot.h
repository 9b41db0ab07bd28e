#ifndef talus_observers_snapshot_h
#define talus_observers_snapshot_h

#include <talus/observers/boxes.h>

namespace talus
{
  template <int dim>
  using Snapshot = State<dim>;
} // namespace talus

#endif

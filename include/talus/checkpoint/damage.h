// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_damage_h
#define talus_checkpoint_damage_h

#include <talus/checkpoint/checkpoint_content.h>

namespace talus
{
  /// Return a description of the damage of a checkpoint with the state file
  /// @p file: wrong checksums, wrong extents, or impossible numbers; empty if
  /// there is no damage. Collective.
  std::string
  find_damage(Hdf5InputFile &file, const CheckpointHead &head);
} // namespace talus

#endif

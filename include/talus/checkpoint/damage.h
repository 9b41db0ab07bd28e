// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_damage_h
#define talus_checkpoint_damage_h

#include <talus/checkpoint/checkpoint_content.h>

namespace talus
{
  /// What is wrong with the checkpoint of which this is the state: with its
  /// checksums, its extents, or numbers that no run can have had; empty if
  /// nothing is. Collective.
  std::string
  find_damage(Hdf5InputFile &file, const CheckpointHead &head);
} // namespace talus

#endif

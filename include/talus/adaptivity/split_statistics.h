// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_split_statistics_h
#define talus_adaptivity_split_statistics_h

namespace talus
{
  /// Number and accuracy of the splits so far, on this rank.
  struct SplitStatistics
  {
    unsigned long n_splits           = 0;
    unsigned int  largest_generation = 0;
    /// Largest relative error [-] of mass, momentum, kinetic and elastic energy
    /// and centre of mass, summed over all splits.
    double conservation_error = 0;
  };



  /// Numbers of points that are stretched too far but not split, by the limit
  /// that forbids the split. Each point counts once.
  struct UnsplitPoints
  {
    /// Points that have been split `Maximum generation` times.
    unsigned long at_generation_limit = 0;
    /// Points whose children would lie too far outside the mesh.
    unsigned long at_mesh_limit = 0;
    /// Points stretched beyond `Threshold` along an axis, but no longer than
    /// `Minimum length`. Their boxes fit into their cells.
    unsigned long at_length_limit = 0;
  };
} // namespace talus

#endif

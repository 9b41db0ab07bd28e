// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_adaptivity_split_statistics_h
#define talus_adaptivity_split_statistics_h

namespace talus
{
  /// What the splitter has done so far.
  struct SplitStatistics
  {
    unsigned long n_splits           = 0;
    unsigned int  largest_generation = 0;
    /// Largest relative error, over mass, momentum, kinetic and elastic energy
    /// and centre of mass, of the sums over all splits of before - after.
    double ledger = 0;
  };



  /// Numbers of points that are stretched too far and are not split, by the
  /// limit that forbids the split. A point counts once.
  struct UnsplitPoints
  {
    /// Points with `Maximum generation` splits behind them.
    unsigned long at_generation_limit = 0;
    /// Points whose children would lie too far outside the mesh.
    unsigned long at_mesh_limit = 0;
    /// Points stretched beyond `Threshold` along an axis, but not longer than
    /// `Minimum length`. Their boxes fit into their cells.
    unsigned long at_length_limit = 0;
  };
} // namespace talus

#endif

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
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_parameter_changes_h
#define talus_checkpoint_parameter_changes_h

#include <map>
#include <string>

namespace talus
{
  /// Return the values of @p parameters, a parameter file as written by a run,
  /// by path, "Section/Subsection/Entry".
  std::map<std::string, std::string>
  values_by_path(const std::string &parameters);

  /// Compare the parameters of a checkpoint, @p saved, with the parameters of
  /// the run to be resumed, @p now; both as parameter files. Throws ExcUser
  /// with the first relevant difference. Allowed are differences in the title,
  /// end time, end at rest, maximum number of points, in output (except format
  /// and runout), checkpoints and load balance, and an added stage 'dynamics'.
  void
  check_parameter_changes(const std::string &saved, const std::string &now);
} // namespace talus

#endif

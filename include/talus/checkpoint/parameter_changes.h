// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_checkpoint_parameter_changes_h
#define talus_checkpoint_parameter_changes_h

#include <string>

namespace talus
{
  /// The value of the parameter "Section/Subsection/Entry" in a text in the
  /// language of parameter files, as a run has written it; empty without one.
  std::string
  parameter_in(const std::string &parameters, const std::string &path);

  /// Compare the parameters of a checkpoint with those of the run that is to go
  /// on from it, both in the language of parameter files. Throws ExcUser,
  /// naming the first one that differs, unless all that differ are harmless: the
  /// title, the end time, the limit on the number of points, and those of
  /// output, checkpoints and load balance; or a stage 'dynamics' was added.
  void
  check_parameter_changes(const std::string &saved, const std::string &now);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_run_record_h
#define talus_io_run_record_h

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Version of talus and of the libraries under it, one per line, each line
  /// after @p prefix.
  std::string
  versions(const std::string &prefix = "");



  /// The parameters as understood, defaults included, without documentation.
  std::string
  parameters_as_text(const dealii::ParameterHandler &parameters);



  /// Write the parameters as understood, defaults included, to the file
  /// @p path, which talus can read again; its head says which talus and which
  /// libraries understood them. Throws ExcUser if the file cannot be written.
  void
  write_run_record(const std::filesystem::path    &path,
                   const dealii::ParameterHandler &parameters);



  /// Whether @p path is such a record, unchanged.
  bool
  is_run_record(const std::filesystem::path &path);
} // namespace talus

#endif

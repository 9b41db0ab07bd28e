// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_io_run_record_h
#define talus_io_run_record_h

#include <deal.II/base/parameter_handler.h>

#include <filesystem>
#include <string>

namespace talus
{
  /// Return the versions of talus and of the libraries, one per line, each line
  /// after @p prefix.
  std::string
  versions(const std::string &prefix = "");



  /// Return the parameters as understood, with defaults, without documentation.
  std::string
  parameters_as_text(const dealii::ParameterHandler &parameters);



  /// Write the text of parameters_as_text() to the file @p path, in a form that
  /// talus can read again; the header lists the versions of talus and of the
  /// libraries. Throws ExcUser if the file cannot be written.
  void
  write_run_record(const std::filesystem::path &path,
                   const std::string           &parameters);



  /// Return whether @p path is an unchanged file of write_run_record().
  bool
  is_run_record(const std::filesystem::path &path);
} // namespace talus

#endif

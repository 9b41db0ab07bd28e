// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_manual_h
#define talus_application_manual_h

#include <boost/program_options/options_description.hpp>

#include <ostream>

namespace talus
{
  /// Write the man page talus(1) with all @p options.
  void
  write_manual(std::ostream                                      &out,
               const boost::program_options::options_description &options);

  /// Write the completion script of talus for bash.
  void
  write_completion(std::ostream                                      &out,
                   const boost::program_options::options_description &options);
} // namespace talus

#endif

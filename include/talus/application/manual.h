// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_manual_h
#define talus_application_manual_h

#include <boost/program_options/options_description.hpp>

#include <ostream>

namespace talus
{
  /// The man page talus(1), of all @p options.
  void
  write_manual(std::ostream                                      &out,
               const boost::program_options::options_description &options);

  /// What bash sources to complete the command line of talus.
  void
  write_completion(std::ostream                                      &out,
                   const boost::program_options::options_description &options);
} // namespace talus

#endif

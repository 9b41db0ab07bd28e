// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_message_h
#define talus_application_message_h

#include <exception>
#include <string>

namespace talus
{
  /// Return the message of an exception as one line for the user: what was
  /// found, where, what was expected and what to do. Incomplete messages of
  /// deal.II's parameter parser and of Boost.Program_options are rewritten.
  std::string
  message(const std::exception &exception);
} // namespace talus

#endif

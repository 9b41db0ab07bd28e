// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_application_message_h
#define talus_application_message_h

#include <exception>
#include <string>

namespace talus
{
  /// What went wrong as one line for the user: what was found, where, what was
  /// expected and what to do. Messages of deal.II's parameter parser and of
  /// Boost.Program_options, which tell only half of it, are said anew.
  std::string
  message(const std::exception &exception);
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_errors_h
#define talus_base_errors_h

#include <deal.II/base/exceptions.h>

#include <iomanip>
#include <sstream>
#include <string>

namespace talus
{
  /// A point met a state that the simulation cannot continue from. The message
  /// names the point, its place and the likely cure; the program writes the
  /// last state before it stops.
  DeclException1(ExcPoint, std::string, << arg1);

  /// What the user asked for cannot be done: one sentence that says what was
  /// found, where, what was expected and what to do.
  DeclException1(ExcUser, std::string, << arg1);



  /// Stream the arguments into one string: text("h = ", h, " m"). With ten
  /// digits, so that numbers that differ look different, and places in UTM
  /// coordinates are told to the millimetre; a sentence that wants fewer of a
  /// computed number says std::setprecision.
  template <typename... Arguments>
  std::string
  text(const Arguments &...arguments)
  {
    std::ostringstream out;
    out.precision(10);
    (out << ... << arguments);
    return out.str();
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_errors_h
#define talus_base_errors_h

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>

namespace talus
{
  /// A point has a state from which the simulation cannot continue. The message
  /// names the point, its position and the likely remedy; the program writes
  /// the last state before it stops.
  DeclException1(ExcPoint, std::string, << arg1);

  /// Input of the user is invalid. The message is a sentence with the value
  /// found, its location, the value expected and the remedy.
  DeclException1(ExcUser, std::string, << arg1);



  /// Stream the arguments into a string: text("h = ", h, " m"). Ten digits
  /// distinguish different numbers and give UTM coordinates to the millimetre;
  /// use std::setprecision for fewer digits of a computed number.
  template <typename... Arguments>
  std::string
  text(const Arguments &...arguments)
  {
    std::ostringstream out;
    out.precision(10);
    (out << ... << arguments);
    return out.str();
  }



  /// Return "1 cell", "2 cells", or "1.25 cells" for the noun "cell".
  inline std::string
  counted(const double n, const std::string &noun)
  {
    return text(std::setprecision(n == std::floor(n) ? 15 : 3),
                n,
                ' ',
                noun,
                n == 1. ? "" : "s");
  }
} // namespace talus

#endif

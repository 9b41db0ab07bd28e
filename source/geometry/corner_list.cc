// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/geometry/corner_list.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  std::vector<Point<2>>
  parse_corners(const std::string &path, const std::string &list)
  {
    std::vector<Point<2>> corners;
    for (const auto &corner : Utilities::split_string_list(list, ';'))
      {
        const auto numbers = Utilities::split_string_list(corner, ',');
        // Squares of larger numbers would overflow.
        const Patterns::Double number(-1e9, 1e9);
        AssertThrow(numbers.size() == 2 && number.match(numbers[0]) &&
                      number.match(numbers[1]),
                    ExcUser(
                      text(path,
                           " contains '",
                           corner,
                           "', where two numbers of at most 1e9 m, separated "
                           "by a comma, were expected; corners are separated "
                           "by semicolons.")));
        corners.emplace_back(Utilities::string_to_double(numbers[0]),
                             Utilities::string_to_double(numbers[1]));
      }
    return corners;
  }
} // namespace talus

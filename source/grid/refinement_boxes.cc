// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/grid/refinement_boxes.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Parse a corner of a refinement box, m; @p boxes is the whole parameter,
    /// for messages.
    template <int dim>
    Point<dim>
    parse_corner(const std::string &corner, const std::string &boxes)
    {
      const auto numbers = Utilities::split_string_list(corner, ',');
      Point<dim> x;
      AssertThrow(numbers.size() == dim,
                  ExcUser("'Grid/Refinement boxes = " + boxes +
                          "' contains the corner '" + corner + "'; expected " +
                          std::to_string(dim) +
                          " numbers separated by commas."));
      for (unsigned int d = 0; d < dim; ++d)
        {
          AssertThrow(Patterns::Double().match(numbers[d]),
                      ExcUser("'Grid/Refinement boxes = " + boxes +
                              "' contains '" + numbers[d] +
                              "'; expected a number."));
          x[d] = Utilities::string_to_double(numbers[d]);
        }
      return x;
    }
  } // namespace



  // A box outside of the mesh is an error: it would have no effect without any
  // message.
  template <int dim>
  std::vector<RefinementBox<dim>>
  parse_refinement_boxes(const std::string      &boxes,
                         const Box<dim>         &domain,
                         const PlaceCoordinates &coordinates)
  {
    std::vector<RefinementBox<dim>> result;
    for (const auto &entry : Utilities::split_string_list(boxes, '|'))
      {
        const auto parts = Utilities::split_string_list(entry, ';');
        AssertThrow(parts.size() == 3 &&
                      Patterns::Integer(1, 10).match(parts[2]),
                    ExcUser("'Grid/Refinement boxes = " + boxes +
                            "' contains '" + entry +
                            "'; expected 'lower corner; upper corner; n' with "
                            "n from 1 to 10."));
        const Point<dim> lower = parse_corner<dim>(parts[0], boxes);
        const Point<dim> upper = parse_corner<dim>(parts[1], boxes);
        const Box<dim>   box   = coordinates.box(lower, upper);
        for (unsigned int d = 0; d < dim; ++d)
          AssertThrow(box.lower[d] < box.upper[d],
                      ExcUser("'Grid/Refinement boxes = " + boxes +
                              "' contains '" + entry +
                              "', whose upper corner must lie above the lower "
                              "one in every coordinate."));
        for (unsigned int d = 0; d < dim; ++d)
          AssertThrow(box.lower[d] < domain.upper[d] &&
                        box.upper[d] > domain.lower[d],
                      ExcUser(text("'Grid/Refinement boxes = ",
                                   boxes,
                                   "' contains '",
                                   entry,
                                   "', which is the box from (",
                                   box.lower,
                                   ") to (",
                                   box.upper,
                                   ") m and lies outside the mesh from (",
                                   domain.lower,
                                   ") to (",
                                   domain.upper,
                                   ") m. Move or remove it.")));
        result.push_back({box, static_cast<unsigned int>(std::stoi(parts[2]))});
      }
    return result;
  }



  // The tolerance excludes cells that only share a face with the box, for any
  // round-off in the corners.
  template <int dim>
  bool
  overlap(const RefinementBox<dim> &box,
          const Point<dim>         &lower,
          const double              size)
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (!(lower[d] < box.box.upper[d] - 1e-9 * size &&
            lower[d] + size > box.box.lower[d] + 1e-9 * size))
        return false;
    return true;
  }



  template decltype(parse_refinement_boxes<2>) parse_refinement_boxes<2>;
  template decltype(parse_refinement_boxes<3>) parse_refinement_boxes<3>;
  template decltype(overlap<2>)                overlap<2>;
  template decltype(overlap<3>)                overlap<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_layer_h
#define talus_problem_layer_h

#include <talus/geometry/side_of_surface.h>

#include <algorithm>
#include <array>
#include <vector>

namespace talus
{
  /// Thickness that counts as round-off, in cells: beyond the end of a layer
  /// both surfaces may coincide.
  constexpr double thickness_of_round_off = 1e-5;



  /// View of the shape of a layer: limits in plan, and two surfaces. The shape
  /// must outlive the view.
  template <int dim>
  class Layer
  {
  public:
    explicit Layer(const Shape<dim> &shape)
    {
      for (const Shape<dim> *part : shape.parts())
        if (const auto *side = dynamic_cast<const SideOfSurface<dim> *>(part))
          sides_.push_back(side);
        else
          outline_.push_back(part);
    }

    /// Return whether the shape has two surfaces.
    bool
    is_layer() const
    {
      return sides_.size() == 2;
    }

    /// Return whether @p x lies within the limits in plan, and both surfaces
    /// are defined there.
    bool
    is_in_plan(const dealii::Point<dim> &x) const
    {
      return std::all_of(outline_.begin(),
                         outline_.end(),
                         [&x](const auto *part) {
                           return part->contains(x);
                         }) &&
             is_known_at(x);
    }

    /// Return whether the surfaces are defined at @p x.
    bool
    is_known_at(const dealii::Point<dim> &x) const
    {
      return std::all_of(sides_.begin(), sides_.end(), [&x](const auto *side) {
        return side->is_known_at(x);
      });
    }

    /// Return the heights of the lower and the upper surface at @p x, m; the
    /// lower surface is above where the surfaces have crossed.
    std::array<double, 2>
    ends(const dealii::Point<dim> &x) const
    {
      std::array<double, 2> result{};
      for (const auto *side : sides_)
        {
          // Distances are to tangent planes at x.
          const auto [distance, normal] = side->distance_and_normal(x);
          result[normal[1] > 0.]        = x[1] - distance / normal[1];
        }
      return result;
    }

  private:
    std::vector<const Shape<dim> *>         outline_;
    std::vector<const SideOfSurface<dim> *> sides_;
  };
} // namespace talus

#endif

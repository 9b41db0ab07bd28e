// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/problem/layer.h>
#include <talus/problem/layer_surfaces.h>
#include <talus/problem/plan_places.h>

#include <limits>

namespace talus
{
  using namespace dealii;

  template <int dim>
  std::string
  check_layer_surfaces(const Body<dim> &body,
                       const Box<dim>  &domain,
                       const double     cell_size)
  {
    const auto       shape = body.shape(domain);
    const Layer<dim> layer(*shape);
    if (!layer.is_layer())
      return "";
    double       largest = -std::numeric_limits<double>::infinity();
    double       least   = -largest;
    Point<dim>   place; // of the minimum thickness
    unsigned int n_places = 0, n_crossed = 0;
    for (const Point<dim> &x : plan_places(domain, cell_size))
      if (layer.is_in_plan(x))
        {
          const auto [lower, upper] = layer.ends(x);
          const double thickness    = upper - lower;
          ++n_places;
          n_crossed += (thickness < -thickness_of_round_off * cell_size);
          largest = std::max(largest, thickness);
          if (thickness < least)
            {
              least = thickness;
              place = x;
            }
        }
    const std::string section = "Bodies/" + body.name();
    AssertThrow(n_places == 0 || largest > thickness_of_round_off * cell_size,
                ExcUser(
                  text("The layer '",
                       body.name(),
                       "' has no thickness: '",
                       section,
                       "/Upper surface' is at most ",
                       largest,
                       " m above '",
                       section,
                       "/Lower surface', without space for soil in between. "
                       "Correct one of the surfaces.")));
    if (n_crossed == 0)
      return "";
    return text(std::setprecision(4),
                "The lower surface of the layer '",
                body.name(),
                "' lies above the upper surface over ",
                100. * n_crossed / n_places,
                " % of the plan, by up to ",
                -least,
                " m, at x = ",
                place[0],
                dim == 3 ? text(" m, z = ", place[dim - 1]) : "",
                " m: there is no soil there. To avoid the gap, correct '",
                section,
                "/Upper surface' or '",
                section,
                "/Lower surface'.");
  }



  template decltype(check_layer_surfaces<2>) check_layer_surfaces<2>;
  template decltype(check_layer_surfaces<3>) check_layer_surfaces<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
// One clay, cut into several bodies: the same slide. Fails as soon as anything
// that the points of a cell share is taken per body.

#include "landslide.h"

#include <talus/base/errors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

using namespace talus;
using namespace talus::cases;

namespace
{
  /// The trapezoid of the paper in @p n horizontal layers, bottom first.
  Overrides
  in_layers(const unsigned int n)
  {
    const double       height = 5., length = 48.66, run = 8.66;
    Overrides          result;
    std::ostringstream names;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double lower = i * height / n, upper = (i + 1) * height / n;
        const auto   x_at = [&](const double y) { return run * y / height; };
        std::ostringstream name, vertices;
        // That of the file, whose name stays known.
        name << (i == 0 ? "slide" : text("layer", i));
        vertices << std::setprecision(17) << x_at(lower) << ',' << lower << "; "
                 << length - x_at(lower) << ',' << lower << "; "
                 << length - x_at(upper) << ',' << upper << "; " << x_at(upper)
                 << ',' << upper;
        names << (i == 0 ? "" : ",") << name.str();
        const std::string path = "Bodies/" + name.str() + "/";
        result.push_back(path + "Shape=polygon");
        result.push_back(path + "Vertices=" + vertices.str());
        result.push_back(path + "Material=clay");
        result.push_back(path + "Filling=centres");
      }
    result.push_back("Bodies/Names=" + names.str());
    return result;
  }



  struct State
  {
    unsigned int        n_bodies = 0;
    std::vector<double> mean_stress;   // Pa, ascending
    std::vector<double> x;             // m, ascending
    double              centre_x = 0.; // m
  };

  template <int dim>
  State
  state_at(Case<dim> &slide, const double time)
  {
    while (slide->state().time < time)
      slide->advance();
    const Points<dim> &points = slide.points();
    State              state;
    double             mass = 0.;
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        double trace = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          trace += points.data(points.stress, d)[p];
        state.mean_stress.push_back(trace / 3.);
        const double m = points.data(points.mass)[p];
        state.x.push_back(points.data(points.position, 0)[p]);
        state.centre_x += m * state.x.back();
        mass += m;
        state.n_bodies =
          std::max(state.n_bodies,
                   static_cast<unsigned int>(points.data(points.body)[p]) + 1);
      }
    state.centre_x /= mass;
    std::sort(state.mean_stress.begin(), state.mean_stress.end());
    std::sort(state.x.begin(), state.x.end());
    return state;
  }



  double
  percentile(const std::vector<double> &sorted, const double share)
  {
    return sorted[static_cast<std::size_t>(share * (sorted.size() - 1))];
  }



  /// The state at each of some times, s.
  template <int dim>
  std::vector<State>
  run_to(const std::string         &file,
         const Overrides           &overrides,
         const std::vector<double> &times)
  {
    Case<dim>          slide(file, overrides);
    std::vector<State> states;
    for (const double time : times)
      states.push_back(state_at(slide, time));
    return states;
  }



  void
  expect_same(Verification      &gates,
              const std::string &name,
              const State       &one,
              const State       &several,
              const unsigned int n_bodies)
  {
    EXPECT_EQ(one.n_bodies, 1u);
    EXPECT_EQ(several.n_bodies, n_bodies);
    ASSERT_EQ(one.x.size(), several.x.size());
    double of_stress = 0., scale = 0.;
    for (std::size_t p = 0; p < one.x.size(); ++p)
      {
        of_stress =
          std::max(of_stress,
                   std::abs(one.mean_stress[p] - several.mean_stress[p]));
        scale = std::max(scale, std::abs(one.mean_stress[p]));
      }
    gates.at_most(name + ": front, relative difference",
                  std::abs(several.x.back() / one.x.back() - 1.),
                  1e-9);
    gates.at_most(name + ": centre of mass, relative difference",
                  std::abs(several.centre_x / one.centre_x - 1.),
                  1e-9);
    gates.at_most(name + ": mean stress of the points, relative difference",
                  of_stress / scale,
                  1e-9);
  }
} // namespace



TEST(LandslideOfLayers, FiveBodiesSlideAsOne)
{
  Verification    gates("Landslide of five bodies of one clay, h = 0.5 m",
                     "prm/landslide-quick.prm, Grid/Cell size=0.5, five layers",
                     "the slide of one body");
  const Overrides coarse          = {"Grid/Cell size=0.5",
                                     "Splitting/Directions=stretched",
                                     "Splitting/Shear=ignored"};
  const std::vector<double> times = {5., 30.};
  const auto one = run_to<2>("landslide-quick.prm", coarse, times);
  const auto five =
    run_to<2>("landslide-quick.prm", coarse + in_layers(5), times);
  expect_same(gates, "five bodies, 5 s", one[0], five[0], 5);
  gates.at_most("five bodies, at rest: front, relative difference",
                std::abs(five[1].x.back() / one[1].x.back() - 1.),
                1e-3);
  for (const double share : {0.01, 0.99})
    gates.at_most(text("five bodies, at rest: percentile ",
                       100 * share,
                       " of the mean stress, difference [kPa]"),
                  std::abs(percentile(five[1].mean_stress, share) -
                           percentile(one[1].mean_stress, share)) /
                    1e3,
                  1.);
}



TEST(LandslideOfLayers, SevenBodiesSlideAsOneIn3d)
{
  Verification gates("3-D landslide of seven bodies of one clay, h = 0.8 m",
                     "prm/landslide-3d.prm, seven layers",
                     "the slide of one body");
  // Points of different bodies are not merged.
  const Overrides kept = {"Splitting/Merge=false"};
  const auto      one  = run_to<3>("landslide-3d.prm", kept, {4.});
  const auto seven = run_to<3>("landslide-3d.prm", kept + in_layers(7), {4.});
  expect_same(gates, "3-D, seven bodies, 4 s", one[0], seven[0], 7);
}

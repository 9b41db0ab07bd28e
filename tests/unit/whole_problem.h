// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_whole_problem_h
#define talus_tests_unit_whole_problem_h

#include <talus/problem/problem.h>
#include <talus/transfer/relocation.h>

#include "core_setup.h"

namespace
{
  /// A body "slide" of von Mises material, 1 m high from x = 2 to 4 m on the
  /// bottom of a mesh of 8 m x 4 m with cells of 0.5 m: all rooms up to the
  /// problem, on one rank. @p Observed declares further parameters.
  template <typename Observed>
  struct WholeProblem : FreshParameters, talus::State<2>
  {
    /// @p entries of the body, @p more: further sections.
    explicit WholeProblem(const std::string &entries = "",
                          const std::string &more    = "")
      : talus::State<2>(MPI_COMM_SELF)
      , problem({2, {"slide"}, {}, {}, {{"clay", "von Mises"}}, "", {}})
    {
      using dealii::ParameterAcceptor;
      ParameterAcceptor::declare_all_parameters();
      ParameterAcceptor::prm.parse_input_from_string(
        mesh("0, 0", "8, 4", "0.5") +
        in_section("Materials",
                   in_section("clay",
                              "set Density = 2000\n"
                              "set Submerged density = 800\n"
                              "set Undrained shear strength = 5000")) +
        in_section("Bodies",
                   "set Names = slide\n" +
                     in_section("slide",
                                "set Material = clay\nset Shape = box\n"
                                "set Lower corner = 2, 0\n"
                                "set Upper corner = 4, 1\n" +
                                  entries)) +
        more);
      ParameterAcceptor::parse_all_parameters();
      grid.check();
      problem.prepare(points, false, 100., grid);
      grid.create({});
      grid.refine();
      grid.prepare();
      nodes.prepare(grid);
      problem.create_points(*this);
      problem.locate(grid);
      sort();
    }

    void
    sort()
    {
      relocation.update(points, grid);
    }

    Observed             observed; ///< before the parameters are declared
    talus::Problem<2>    problem;
    talus::Relocation<2> relocation;
  };
} // namespace

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_obstacles_setup_h
#define talus_tests_unit_obstacles_setup_h

#include <talus/contact/obstacles.h>

#include <deal.II/base/parameter_acceptor.h>

#include <initializer_list>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

/// Obstacles by name and entries, "Shape = ball|Radius = 1": behind all other
/// objects with parameters, which keep theirs. Shapes may name @p surfaces.
template <int dim>
struct WithObstacles
{
  using Section = std::pair<std::string, std::string>;

  WithObstacles(const std::initializer_list<Section> &sections,
                const talus::SurfaceSource<dim>      *surfaces = nullptr)
    : obstacles(names_of(sections))
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    dealii::ParameterAcceptor::declare_all_parameters();
    for (const auto &[name, entries] : sections)
      {
        std::istringstream in(entries);
        for (std::string entry; std::getline(in, entry, '|');)
          prm.parse_input_from_string("subsection Obstacles\nsubsection " +
                                      name + "\nset " + entry + "\nend\nend\n");
      }
    dealii::ParameterAcceptor::parse_all_parameters();
    obstacles.prepare(talus::Constants(), surfaces);
  }

  static std::vector<std::string>
  names_of(const std::initializer_list<Section> &sections)
  {
    std::vector<std::string> names;
    for (const Section &section : sections)
      names.push_back(section.first);
    return names;
  }

  talus::Obstacles<dim> obstacles;
};

#endif

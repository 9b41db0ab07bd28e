// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef observers_setup_h
#define observers_setup_h

#include <talus/base/errors.h>
#include <talus/observers/boxes.h>

#include <deal.II/base/parameter_acceptor.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <unistd.h>

/// What is said to the user when @p action fails.
template <typename Action>
std::string
sentence_thrown_by(Action &&action)
{
  try
    {
      action();
    }
  catch (const talus::ExcUser &error)
    {
      std::ostringstream out;
      error.print_info(out);
      return out.str();
    }
  return "no error";
}



/// A mesh of cells of 1 m, some points, and all else an observer looks at.
template <int dim>
struct Scene : public talus::State<dim>
{
  using talus::State<dim>::grid;
  using talus::State<dim>::nodes;
  using talus::State<dim>::points;

  Scene(const std::string &lower, const std::string &upper)
    : talus::State<dim>(MPI_COMM_WORLD)
  {
    auto &prm = dealii::ParameterAcceptor::prm;
    dealii::ParameterAcceptor::declare_all_parameters();
    prm.parse_input_from_string(
      "subsection Grid\n set Lower corner = " + lower +
      "\n set Upper corner = " + upper + "\n set Cell size = 1\nend\n");
    dealii::ParameterAcceptor::parse_all_parameters();
    grid.create({});
    grid.refine();
    grid.prepare();
    nodes.prepare(grid);
    for (const std::string name :
         {"friction work", "contact work", "damping work"})
      this->accounts.open_energy(name);
    this->accounts.open_energy("gravity work",
                               talus::Accounts<dim>::EnergyKind::supplied);
    this->accounts.open_impulse("seabed impulse");
  }

  /// Boxes are half a cell wide and undeformed. (The velocity is a Point
  /// because that can be written as a list.)
  unsigned int
  add(const dealii::Point<dim> &x,
      const double              mass     = 1.,
      const dealii::Point<dim> &velocity = dealii::Point<dim>())
  {
    const unsigned int p        = points.append(1);
    points.data(points.mass)[p] = mass;
    points.data(points.id)[p]   = p;
    for (unsigned int d = 0; d < dim; ++d)
      {
        points.data(points.position, d)[p]           = x[d];
        points.data(points.initial_position, d)[p]   = x[d];
        points.data(points.velocity, d)[p]           = velocity[d];
        points.data(points.edges, d * (dim + 1))[p]  = 0.5;
        points.data(points.box_length, d)[p]         = 0.5;
        points.data(points.length_at_creation, d)[p] = 0.5;
      }
    points.data(points.reference_volume)[p] = std::pow(0.5, dim);
    return p;
  }

  /// Stretch an undeformed point @p p and its box along axis @p d.
  void
  stretch(const unsigned int p, const unsigned int d, const double factor)
  {
    points.data(points.edges, d * (dim + 1))[p] *= factor;
    points.data(points.box_length, d)[p] *= factor;
  }

  /// Sort the points by cell.
  void
  sort()
  {
    std::vector<std::vector<unsigned int>> of_cell(grid.cells().size());
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        dealii::Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = points.data(points.position, d)[p];
        of_cell[grid.find_cell(x)].push_back(p);
      }
    std::vector<talus::ElementMove> element_moves;
    std::vector<talus::Segment>     segments;
    for (unsigned int c = 0; c < of_cell.size(); ++c)
      if (!of_cell[c].empty())
        {
          const unsigned int begin = element_moves.size();
          for (const unsigned int p : of_cell[c])
            element_moves.push_back({p, unsigned(element_moves.size())});
          segments.push_back({c, 0, begin, unsigned(element_moves.size())});
        }
    points.reorder({}, element_moves, segments);
  }
};



/// A test with an empty folder of its own.
class ObserversTest : public testing::Test
{
protected:
  ObserversTest()
  {
    dealii::ParameterAcceptor::clear();
    const auto *test = testing::UnitTest::GetInstance()->current_test_info();
    folder           = std::filesystem::temp_directory_path() /
             ("talus-" + std::string(test->test_suite_name()) + "-" +
              test->name() + "-" + std::to_string(getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }

  ~ObserversTest() override
  {
    std::filesystem::remove_all(folder);
  }

  std::vector<std::string>
  lines(const std::string &name) const
  {
    std::vector<std::string> result;
    std::ifstream            file(folder / name);
    for (std::string line; std::getline(file, line);)
      result.push_back(line);
    return result;
  }

  std::filesystem::path folder;
};

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "case.h"

#include <talus/application/parameter_file.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace talus::cases
{
  using dealii::ParameterAcceptor;

  std::string
  parameter_file(const std::string &name)
  {
    const std::filesystem::path own =
      std::filesystem::path(TALUS_CASES_SOURCE_DIR) / name;
    return std::filesystem::exists(own)
             ? own.string()
             : (std::filesystem::path(TALUS_PRM_DIR) / name).string();
  }



  template <int dim>
  Case<dim>::Case(const std::string &file, const Overrides &overrides)
  {
    const ParameterFile parameters(parameter_file(file),
                                   overrides,
                                   MPI_COMM_WORLD);
    simulation_ =
      std::make_unique<Simulation<dim>>(parameters.preview(), MPI_COMM_WORLD);
    parameters.parse();
    simulation_->set_up();
    simulation_->allow_overwriting(); // what an earlier run of the test left
  }



  template <int dim>
  Case<dim>::~Case()
  {
    // First the objects, then the list of them.
    simulation_.reset();
    ParameterAcceptor::clear();
    ParameterAcceptor::prm.clear();
  }



  Table::Table(const std::filesystem::path &path)
  {
    std::ifstream            file(path);
    std::string              line, word;
    std::vector<std::string> names;
    std::getline(file, line);
    for (std::istringstream words(line); std::getline(words, word, ',');)
      names.push_back(word);
    if (names.empty())
      throw std::runtime_error("No table in " + path.string());
    while (std::getline(file, line))
      {
        // The comma at the end lets an empty last field be read.
        std::istringstream words(line + ',');
        unsigned int       n = 0;
        for (; n < names.size() && std::getline(words, word, ','); ++n)
          columns_[names[n]].push_back(
            word.empty() ? std::numeric_limits<double>::quiet_NaN()
                         : std::stod(word));
        if (n != names.size() || std::getline(words, word, ','))
          throw std::runtime_error("Bad row in " + path.string() + ": " + line);
      }
  }



  const std::vector<double> &
  Table::operator[](const std::string &name) const
  {
    const auto column = columns_.find(name);
    if (column == columns_.end())
      throw std::runtime_error("statistics.csv has no column '" + name + "'");
    return column->second;
  }



  double
  Table::at(const double time, const std::string &name) const
  {
    const std::vector<double> &t = (*this)["time [s]"], &y = (*this)[name];
    if (!(time >= t.front() && time <= t.back()))
      throw std::runtime_error("No row near t = " + std::to_string(time));
    unsigned int i = 1;
    while (i + 1 < t.size() && t[i] < time)
      ++i;
    return y[i - 1] + (y[i] - y[i - 1]) * (time - t[i - 1]) / (t[i] - t[i - 1]);
  }



  template <int dim>
  Table
  run(const std::string &file,
      const std::string &name,
      const Overrides   &overrides)
  {
    const auto folder = std::filesystem::path(TALUS_RESULTS_DIR) / name;
    std::filesystem::remove_all(folder);
    {
      const Overrides quiet = {"Output/Write points=false",
                               "Output/Write grid=false",
                               "Output/Write obstacles=false",
                               "Output/Folder=" + folder.string()};
      Case<dim>       simulation(file, quiet + overrides);
      simulation->run();
    }
    return Table(folder / "statistics.csv");
  }



  Table
  shared_run(const std::string &name)
  {
    const auto folder =
      std::filesystem::path(TALUS_RESULTS_DIR) / "runs" / name;
    if (!std::filesystem::exists(folder.string() + ".json"))
      throw std::runtime_error("The run '" + name + "' is not in " +
                               folder.string() + ". Compute it by 'ctest -R " +
                               "run/" + name +
                               "', or start the suite by ctest.");
    return Table(folder / "statistics.csv");
  }



  Overrides
  operator+(Overrides first, const Overrides &second)
  {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }



  double
  slope(const std::vector<double> &x,
        const std::vector<double> &y,
        const double               lower,
        const double               upper)
  {
    double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
    for (unsigned int i = 0; i < x.size(); ++i)
      if (x[i] >= lower && x[i] <= upper)
        {
          ++n;
          sum_x += x[i];
          sum_y += y[i];
          sum_xx += x[i] * x[i];
          sum_xy += x[i] * y[i];
        }
    return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
  }



  template class Case<2>;
  template class Case<3>;
  template Table
  run<2>(const std::string &, const std::string &, const Overrides &);
  template Table
  run<3>(const std::string &, const std::string &, const Overrides &);
} // namespace talus::cases

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_cases_case_h
#define talus_tests_cases_case_h

#include <talus/simulation/simulation.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace talus::cases
{
  using Overrides = std::vector<std::string>;

  /// Full path of a parameter file of prm/ or of the folder of the tests.
  std::string
  parameter_file(const std::string &name);



  /// A simulation in this process, set up from a parameter file and from
  /// overrides, as by the command line. Only one object at a time: deal.II's
  /// parameters are global.
  template <int dim>
  class Case
  {
  public:
    Case(const std::string &file, const Overrides &overrides);

    /// Forgets the parameters, too.
    ~Case();

    Simulation<dim> *
    operator->()
    {
      return simulation_.get();
    }

    const Points<dim> &
    points() const
    {
      return simulation_->state().points;
    }

  private:
    std::unique_ptr<Simulation<dim>> simulation_;
  };



  /// A CSV file, column by column.
  class Table
  {
  public:
    Table() = default;

    /// Throws if the file cannot be read or a row is not as long as the header.
    explicit Table(const std::filesystem::path &path);

    /// Throws if there is no such column.
    const std::vector<double> &
    operator[](const std::string &name) const;

    unsigned int
    n_rows() const
    {
      return columns_.empty() ? 0 : columns_.begin()->second.size();
    }

    /// Value of a column at @p time, linear between the rows around it.
    double
    at(double time, const std::string &name) const;

  private:
    std::map<std::string, std::vector<double>> columns_;
  };



  /// Run a case to its end, without fields unless the overrides ask for them;
  /// results go to the folder @p name in the build folder. Returns
  /// statistics.csv.
  template <int dim>
  Table
  run(const std::string &file,
      const std::string &name,
      const Overrides   &overrides = {});

  /// statistics.csv of a run that several suites read; ctest computes it before
  /// them, see add_shared_run() of CMakeLists.txt.
  Table
  shared_run(const std::string &name);

  /// @p first and then @p second.
  Overrides
  operator+(Overrides first, const Overrides &second);

  /// Slope of the least-squares line through the points (x, y) with
  /// @p lower <= x <= upper.
  double
  slope(const std::vector<double> &x,
        const std::vector<double> &y,
        double                     lower,
        double                     upper);
} // namespace talus::cases

#endif

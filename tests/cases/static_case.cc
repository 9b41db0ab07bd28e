// SPDX-License-Identifier: LGPL-2.1-or-later
#include "static_case.h"

#include <talus/base/errors.h>

#include <algorithm>
#include <iomanip>

namespace talus::cases
{
  namespace
  {
    std::filesystem::path
    folder_of(const std::string &name)
    {
      return std::filesystem::path(TALUS_RESULTS_DIR) / name;
    }



    /// Overrides for a run without fields in a new folder.
    Overrides
    quiet_in(const std::string &name)
    {
      std::filesystem::remove_all(folder_of(name));
      return {"Output/Write points=false",
              "Output/Write grid=false",
              "Output/Folder=" + folder_of(name).string()};
    }



    bool
    falls(const std::vector<double> &residuals,
          const double               upper,
          const double               lower)
    {
      return residuals.front() > upper && residuals.back() < lower;
    }
  } // namespace



  template <int dim>
  StaticCase<dim>::StaticCase(const std::string &file,
                              const std::string &name,
                              const Overrides   &overrides)
    : folder_(folder_of(name))
    , case_(file, quiet_in(name) + overrides)
    , simulation_(*case_.operator->())
    , points_(case_.points())
  {
    case_->run();
    newton_ = Table(folder_ / "newton.csv");
  }



  template <int dim>
  double
  StaticCase<dim>::factor_of_safety() const
  {
    return simulation_.static_stages().strength_reduction().factor();
  }



  std::vector<std::vector<double>>
  residuals(const Table &newton)
  {
    std::vector<std::vector<double>> result;
    for (unsigned int i = 0; i < newton.n_rows(); ++i)
      {
        if (newton["iteration"][i] == 0.)
          result.emplace_back();
        result.back().push_back(newton["residual [-]"][i]);
      }
    return result;
  }



  double
  quadratic_constant(const Table &newton,
                     const double upper,
                     const double lower)
  {
    double result = 0;
    for (const std::vector<double> &list : residuals(newton))
      for (unsigned int k = 1; k < list.size(); ++k)
        if (list[k - 1] < upper && list[k] > lower)
          result = std::max(result, list[k] / (list[k - 1] * list[k - 1]));
    return result;
  }



  std::string
  a_sequence(const Table &newton, const double upper, const double lower)
  {
    for (const std::vector<double> &list : residuals(newton))
      if (falls(list, upper, lower))
        {
          std::string result;
          for (const double residual : list)
            result +=
              text(result.empty() ? "" : ", ", std::setprecision(2), residual);
          return result;
        }
    return "none";
  }



  template class StaticCase<2>;
  template class StaticCase<3>;
} // namespace talus::cases

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "static_case.h"

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



  template class StaticCase<2>;
  template class StaticCase<3>;
} // namespace talus::cases

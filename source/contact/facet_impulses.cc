// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/assertion.h>
#include <talus/base/key_halves.h>
#include <talus/contact/facet_impulses.h>

#include <algorithm>
#include <map>

namespace talus
{
  using namespace dealii;

  template <int dim>
  FacetName
  name_of(const ContactFacet<dim> &facet)
  {
    const auto [upper, lower] = halves_of_key(facet.key);
    return {{upper, lower, double(facet.obstacle), double(facet.number)}};
  }



  template <int dim>
  void
  FacetImpulses<dim>::set(const std::vector<FacetImpulse<dim>> &impulses)
  {
    TalusAssert(impulses.size() == facets_.owned().size(),
                dealii::ExcDimensionMismatch(impulses.size(),
                                             facets_.owned().size()));
    impulses_ = impulses;
  }



  template <int dim>
  std::vector<double>
  FacetImpulses<dim>::rows() const
  {
    if (has_restored())
      return restored_;
    std::vector<double> rows;
    for (unsigned int c = 0; c < impulses_.size(); ++c)
      if (const FacetImpulse<dim> &impulse = impulses_[c];
          impulse.effective_mass > 0)
        {
          const auto name = name_of(facets_.owned()[c]);
          rows.insert(rows.end(), name.begin(), name.end());
          rows.insert(rows.end(),
                      {impulse.normal,
                       impulse.effective_mass,
                       impulse.mean_normal});
          for (unsigned int d = 0; d < dim; ++d)
            rows.push_back(impulse.tangential[d]);
        }
    return rows;
  }



  template <int dim>
  void
  FacetImpulses<dim>::take(const std::vector<double> &rows)
  {
    std::map<FacetName, FacetImpulse<dim>> by_name;
    for (std::size_t r = 0; r < rows.size(); r += n_columns)
      {
        FacetName name;
        std::copy_n(&rows[r], name.size(), name.begin());
        const double     *value = &rows[r + name.size()];
        FacetImpulse<dim> impulse{value[0], {}, value[1], value[2]};
        for (unsigned int d = 0; d < dim; ++d)
          impulse.tangential[d] = value[3 + d];
        by_name[name] = impulse;
      }
    impulses_.assign(facets_.owned().size(), {});
    for (unsigned int c = 0; c < impulses_.size(); ++c)
      if (const auto found = by_name.find(name_of(facets_.owned()[c]));
          found != by_name.end())
        impulses_[c] = found->second;
  }



  template <int dim>
  void
  FacetImpulses<dim>::take_restored()
  {
    if (!has_restored())
      return;
    const std::vector<double> rows = std::move(restored_);
    restored_.clear();
    take(rows);
  }



  template <int dim>
  void
  FacetImpulses<dim>::list_state(StateList &list)
  {
    list.add_table(
      {"facet impulses",
       "key of the cell: upper and lower 32 bits; obstacle; number of the "
       "facet "
       "in its cell; normal impulse [N s]; effective mass [kg]; mean normal "
       "impulse [N s]; friction impulse [N s]",
       n_columns,
       [this]() { return rows(); },
       [this](const std::vector<double> &rows) { restore(rows); }});
  }



  template decltype(name_of<2>) name_of<2>;
  template decltype(name_of<3>) name_of<3>;

  template class FacetImpulses<2>;
  template class FacetImpulses<3>;
} // namespace talus

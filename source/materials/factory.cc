// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/factory.h>
#include <talus/materials/hencky.h>
#include <talus/materials/herschel_bulkley.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/modified_cam_clay.h>
#include <talus/materials/mohr_coulomb.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/von_mises.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// All laws, one line each; add_law() appends more. The list is explicit,
    /// as objects that register themselves may be dropped by the linker when
    /// nothing refers to them, and their order would depend on the linking.
    template <int dim>
    std::vector<Law<dim>> &
    laws()
    {
      static std::vector<Law<dim>> list = {
        law<dim, LinearElastic>("linear elastic"),
        law<dim, VonMises>("von Mises"),
        law<dim, MohrCoulomb>("Mohr-Coulomb"),
        law<dim, ModifiedCamClay>("modified Cam clay"),
        law<dim, Hencky>("Hencky"),
        law<dim, NeoHookean>("neo-Hookean"),
        law<dim, HerschelBulkley, FlowLaw::herschel_bulkley>(
          "Herschel-Bulkley"),
        law<dim, HerschelBulkley, FlowLaw::bingham>("Bingham")};
      return list;
    }
  } // namespace



  // deal.II separates the allowed values of a parameter by |.
  template <int dim>
  void
  add_law(const Law<dim> &law)
  {
    const auto names = material_names<dim>();
    AssertThrow(std::find(names.begin(), names.end(), law.name) == names.end(),
                ExcUser("A law '" + law.name +
                        "' was added, but a law of the same name exists. Give "
                        "add_law() a different name."));
    AssertThrow(!law.name.empty() &&
                  law.name.find_first_of("|,#\n") == std::string::npos &&
                  law.name == dealii::Utilities::trim(law.name),
                ExcUser("A law '" + law.name +
                        "' was added, but a parameter file cannot contain its "
                        "name. Give add_law() a name without |, commas, # and "
                        "surrounding spaces."));
    laws<dim>().push_back(law);
  }



  template <int dim>
  std::vector<std::string>
  material_names()
  {
    std::vector<std::string> names;
    for (const auto &law : laws<dim>())
      names.push_back(law.name);
    return names;
  }



  // The last name follows "or", as at the end of a sentence.
  template <int dim>
  std::string
  names_of_laws_with_strength()
  {
    std::vector<std::string> names;
    for (const auto &law : laws<dim>())
      if (law.has_strength)
        names.push_back("'" + law.name + "'");
    std::string result = names.front();
    for (unsigned int i = 1; i < names.size(); ++i)
      result += (i + 1 < names.size() ? ", " : " or ") + names[i];
    return result;
  }



  // The name comes from a parameter whose allowed values are the laws, but
  // tests also make materials without the parser.
  template <int dim>
  std::unique_ptr<MaterialModel<dim>>
  make_material(const std::string &name, const std::string &section)
  {
    std::string known;
    for (const auto &law : laws<dim>())
      {
        if (law.name == name)
          return law.make(section);
        known += (known.empty() ? "" : ", ") + law.name;
      }
    AssertThrow(false,
                ExcUser(text("Section ",
                             section,
                             " asks for the unknown law `",
                             name,
                             "`. Choose one of: ",
                             known,
                             ".")));
    return nullptr;
  }



  template decltype(add_law<2>)        add_law<2>;
  template decltype(add_law<3>)        add_law<3>;
  template decltype(material_names<2>) material_names<2>;
  template decltype(material_names<3>) material_names<3>;
  template decltype(names_of_laws_with_strength<2>)
    names_of_laws_with_strength<2>;
  template decltype(names_of_laws_with_strength<3>)
                                      names_of_laws_with_strength<3>;
  template decltype(make_material<2>) make_material<2>;
  template decltype(make_material<3>) make_material<3>;
} // namespace talus

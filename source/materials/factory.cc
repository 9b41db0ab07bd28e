// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/factory.h>
#include <talus/materials/hencky.h>
#include <talus/materials/herschel_bulkley.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/von_mises.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace talus
{
  namespace
  {
    /// All laws, one line each; add_law() appends to them.
    /// A list that is written out, and not one at which laws register
    /// themselves: objects that nobody refers to may be left out by the linker,
    /// and their order would be that of the linking.
    template <int dim>
    std::vector<Law<dim>> &
    laws()
    {
      static std::vector<Law<dim>> list = {
        law<dim, LinearElastic>("linear elastic"),
        law<dim, VonMises>("von Mises"),
        law<dim, Hencky>("Hencky"),
        law<dim, NeoHookean>("neo-Hookean"),
        law<dim, HerschelBulkley, FlowLaw::herschel_bulkley>(
          "Herschel-Bulkley"),
        law<dim, HerschelBulkley, FlowLaw::bingham>("Bingham")};
      return list;
    }
  } // namespace



  // deal.II separates the values that a parameter may have by |.
  template <int dim>
  void
  add_law(const Law<dim> &law)
  {
    const auto names = material_names<dim>();
    AssertThrow(std::find(names.begin(), names.end(), law.name) == names.end(),
                ExcUser("A law '" + law.name +
                        "' was added, but there is one of that name. Give "
                        "add_law() another name."));
    AssertThrow(!law.name.empty() &&
                  law.name.find_first_of("|,#\n") == std::string::npos &&
                  law.name == dealii::Utilities::trim(law.name),
                ExcUser("A law '" + law.name +
                        "' was added, which no parameter file could ask for. "
                        "Give add_law() a name without |, commas, # and "
                        "spaces around it."));
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



  // The message that needs it ends in "or", as sentences do.
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



  // The name comes from a parameter whose range is the list of the laws, but
  // sections may also be made without the parser, as in tests.
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
                             " asks for the law `",
                             name,
                             "`, which there is not. Choose one of: ",
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

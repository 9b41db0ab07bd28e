// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/materials/hencky.h>
#include <talus/materials/herschel_bulkley.h>
#include <talus/materials/linear_elastic.h>
#include <talus/materials/neo_hookean.h>
#include <talus/materials/von_mises.h>

#include <functional>

namespace talus
{
  namespace
  {
    template <int dim>
    // What must be known of a law before a material of it is made: a parameter
    // file is read before, and its messages and documentation name the laws.
    struct Law
    {
      std::string name;
      bool        has_strength;
      std::function<std::unique_ptr<MaterialModel<dim>>(const std::string &)>
        make;
    };



    /// The line of the list for a law: @p Model is its class. Not by
    /// std::make_unique(), which would want to know how the law is destroyed,
    /// and so all of its functions.
    template <int dim, template <int> class Model, auto... arguments>
    Law<dim>
    law(const std::string &name)
    {
      return {name, Model<dim>::is_plastic, [](const std::string &section) {
                return std::unique_ptr<MaterialModel<dim>>(
                  new Model<dim>(section, arguments...));
              }};
    }



    /// All laws, one line each.
    /// A list that is written out, and not one at which laws register
    /// themselves: objects that nobody refers to may be left out by the linker,
    /// and their order would be that of the linking.
    template <int dim>
    std::vector<Law<dim>>
    laws()
    {
      return {law<dim, LinearElastic>("linear elastic"),
              law<dim, VonMises>("von Mises"),
              law<dim, Hencky>("Hencky"),
              law<dim, NeoHookean>("neo-Hookean"),
              law<dim, HerschelBulkley, FlowLaw::herschel_bulkley>(
                "Herschel-Bulkley"),
              law<dim, HerschelBulkley, FlowLaw::bingham>("Bingham")};
    }
  } // namespace



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



  template decltype(material_names<2>) material_names<2>;
  template decltype(material_names<3>) material_names<3>;
  template decltype(names_of_laws_with_strength<2>)
    names_of_laws_with_strength<2>;
  template decltype(names_of_laws_with_strength<3>)
                                      names_of_laws_with_strength<3>;
  template decltype(make_material<2>) make_material<2>;
  template decltype(make_material<3>) make_material<3>;
} // namespace talus

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
    struct Law
    {
      std::string name;
      std::function<std::unique_ptr<MaterialModel<dim>>(const std::string &)>
        make;
    };



    template <int dim, template <int> class Model>
    std::unique_ptr<MaterialModel<dim>>
    make(const std::string &section)
    {
      return std::make_unique<Model<dim>>(section);
    }



    template <int dim, FlowLaw flow_law>
    std::unique_ptr<MaterialModel<dim>>
    make_viscoplastic(const std::string &section)
    {
      return std::make_unique<HerschelBulkley<dim>>(section, flow_law);
    }



    /// All laws, one line each.
    template <int dim>
    std::vector<Law<dim>>
    laws()
    {
      return {{"linear elastic", make<dim, LinearElastic>},
              {"von Mises", make<dim, VonMises>},
              {"Hencky", make<dim, Hencky>},
              {"neo-Hookean", make<dim, NeoHookean>},
              {"Herschel-Bulkley",
               make_viscoplastic<dim, FlowLaw::herschel_bulkley>},
              {"Bingham", make_viscoplastic<dim, FlowLaw::bingham>}};
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



  template std::vector<std::string>
  material_names<2>();
  template std::vector<std::string>
  material_names<3>();
  template std::unique_ptr<MaterialModel<2>>
  make_material(const std::string &, const std::string &);
  template std::unique_ptr<MaterialModel<3>>
  make_material(const std::string &, const std::string &);
} // namespace talus

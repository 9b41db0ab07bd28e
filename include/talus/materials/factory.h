// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_factory_h
#define talus_materials_factory_h

#include <talus/materials/material_model.h>

#include <functional>
#include <memory>
#include <string>

namespace talus
{
  /// Description of a law that is available before any material exists:
  /// messages and documentation of the parameter file list the laws.
  template <int dim>
  struct Law
  {
    std::string name;
    bool        has_strength;
    std::function<std::unique_ptr<MaterialModel<dim>>(const std::string &)>
      make;
  };



  /// Describe the law of class @p Model, constructed from its section and
  /// @p arguments. Avoids std::make_unique(), which would need the destructor
  /// and thus all functions of the law.
  template <int dim, template <int> class Model, auto... arguments>
  Law<dim>
  law(const std::string &name)
  {
    return {name, Model<dim>::is_plastic, [](const std::string &section) {
              return std::unique_ptr<MaterialModel<dim>>(
                new Model<dim>(section, arguments...));
            }};
  }



  /// Add a law to material_names(); call before run_program(). Throws ExcUser
  /// if the name is taken or cannot be the value of a parameter.
  template <int dim>
  void
  add_law(const Law<dim> &law);

  /// Add a law in both dimensions; see doc/examples/own-law.
  template <template <int> class Model, auto... arguments>
  void
  add_law(const std::string &name)
  {
    add_law(law<2, Model, arguments...>(name));
    add_law(law<3, Model, arguments...>(name));
  }
} // namespace talus

#endif

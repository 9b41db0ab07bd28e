// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_materials_factory_h
#define talus_materials_factory_h

#include <talus/materials/material_model.h>

#include <functional>
#include <memory>
#include <string>

namespace talus
{
  /// What must be known of a law before a material of it is made: a parameter
  /// file is read before, and its messages and documentation name the laws.
  template <int dim>
  struct Law
  {
    std::string name;
    bool        has_strength;
    std::function<std::unique_ptr<MaterialModel<dim>>(const std::string &)>
      make;
  };



  /// The law whose class is @p Model, constructed from its section and the
  /// @p arguments. Not by std::make_unique(), which would want to know how the
  /// law is destroyed, and so all of its functions.
  template <int dim, template <int> class Model, auto... arguments>
  Law<dim>
  law(const std::string &name)
  {
    return {name, Model<dim>::is_plastic, [](const std::string &section) {
              return std::unique_ptr<MaterialModel<dim>>(
                new Model<dim>(section, arguments...));
            }};
  }



  /// Add a law to those that material_names() lists, before run_program().
  /// Throws ExcUser if there is one of that name, or if a parameter could not
  /// have it as value.
  template <int dim>
  void
  add_law(const Law<dim> &law);

  /// The same in both dimensions; see doc/examples/own-law.
  template <template <int> class Model, auto... arguments>
  void
  add_law(const std::string &name)
  {
    add_law(law<2, Model, arguments...>(name));
    add_law(law<3, Model, arguments...>(name));
  }
} // namespace talus

#endif

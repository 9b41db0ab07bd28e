// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/problem/quantity_in_depth.h>

#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  QuantityInDepth<dim>::QuantityInDepth(const std::string  &path,
                                        const std::string  &words,
                                        const std::string  &column,
                                        const Inputs<dim>  &inputs,
                                        const Mudline<dim> &mudline,
                                        const Variables     variables)
    : mudline_(mudline)
  {
    if (const std::string table = name_of_table(words); !table.empty())
      {
        table_ = table_in_depth(inputs.folder / table, column);
        return;
      }
    expression_.emplace(
      path, words, inputs.constants, inputs.surfaces.named(), variables);
    expression_->set_depth(
      [this](const Point<dim> &x) { return mudline_.depth(x); });
  }



  std::string
  name_of_table(const std::string &words)
  {
    const std::string keyword = "table ";
    return words.rfind(keyword, 0) == 0
             ? Utilities::trim(words.substr(keyword.size()))
             : "";
  }



  TimeTable
  table_in_depth(const std::filesystem::path &file, const std::string &column)
  {
    return {file,
            {column},
            std::make_pair(std::string("depth"), std::string("m"))};
  }



  template class QuantityInDepth<2>;
  template class QuantityInDepth<3>;
} // namespace talus

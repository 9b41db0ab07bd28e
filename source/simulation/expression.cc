#include <talus/base/errors.h>
#include <talus/simulation/expression.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  template <int dim>
  Expression<dim>::Expression(const std::string &name,
                              const std::string &expressions,
                              const unsigned int n_components)
    : function_(n_components)
  {
    const auto parts = Utilities::split_string_list(expressions, ';');
    AssertThrow(parts.size() == n_components,
                ExcUser(text(name,
                             " = '",
                             expressions,
                             "' has ",
                             parts.size(),
                             " components, but ",
                             n_components,
                             " are needed, separated by semicolons.")));
    function_.initialize(dim == 2 ? "x,y,t" : "x,y,z,t",
                         expressions,
                         {{"pi", numbers::PI}},
                         /*time_dependent=*/true);
    // muParser reads an expression when it is first used: do that now.
    for (unsigned int c = 0; c < n_components; ++c)
      function_.value(Point<dim>(), c);
  }



  template class Expression<2>;
  template class Expression<3>;
} // namespace talus

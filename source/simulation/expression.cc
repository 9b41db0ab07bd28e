#include <talus/base/errors.h>
#include <talus/simulation/expression.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <iostream>
#include <sstream>

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
    // muParser reads an expression when it is first used: do that now. Only
    // here is the parameter's name known, hence the catch; deal.II prints
    // details before it throws, hence the silence.
    std::ostringstream    details;
    std::streambuf *const terminal = std::cerr.rdbuf(details.rdbuf());
    std::string           complaint;
    try
      {
        for (unsigned int c = 0; c < n_components; ++c)
          function_.value(Point<dim>(), c);
      }
    catch (const ExceptionBase &exception)
      {
        std::ostringstream reason;
        exception.print_info(reason);
        complaint = Utilities::trim(reason.str());
      }
    std::cerr.rdbuf(terminal);
    AssertThrow(complaint.empty(),
                ExcUser(text(name,
                             " = '",
                             expressions,
                             "' cannot be understood: ",
                             complaint,
                             " An expression in ",
                             dim == 2 ? "x, y, t" : "x, y, z, t",
                             " and pi was expected; correct it.")));
  }



  template class Expression<2>;
  template class Expression<3>;
} // namespace talus

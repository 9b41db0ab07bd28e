// SPDX-License-Identifier: LGPL-2.1-or-later
#include <talus/base/errors.h>
#include <talus/boundaries/face_expression.h>

#include <deal.II/base/utilities.h>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Return the expressions with 'free' replaced by 0, which is never
    /// evaluated.
    std::string
    without_free(const std::string &expressions)
    {
      std::string result;
      for (const std::string &part :
           Utilities::split_string_list(expressions, ';'))
        result += (result.empty() ? "" : ";") +
                  std::string(part == "free" ? "0" : part);
      return result;
    }
  } // namespace



  // A single parser for all components, also free ones, checks the number of
  // expressions.
  template <int dim>
  FaceExpression<dim>::FaceExpression(const std::string &name,
                                      const std::string &expressions,
                                      const Constants   &constants,
                                      const bool         may_be_free)
    : expression_(name,
                  may_be_free ? without_free(expressions) : expressions,
                  dim,
                  constants)
  {
    const auto parts = Utilities::split_string_list(expressions, ';');
    for (unsigned int d = 0; d < dim; ++d)
      is_prescribed_[d] = !(may_be_free && parts[d] == "free");
  }



  template class FaceExpression<2>;
  template class FaceExpression<3>;
} // namespace talus

// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_face_expression_h
#define talus_boundaries_face_expression_h

#include <talus/base/expression.h>

#include <array>
#include <string>

namespace talus
{
  /// Vector prescribed by the user on a face of the mesh, as a function of
  /// place and time; some components may be free.
  template <int dim>
  class FaceExpression
  {
  public:
    /// Throws ExcUser if the expressions are invalid.
    /// @param name name of the parameter, for messages
    /// @param expressions separated by semicolons, one per component
    /// @param constants named numbers for the expressions
    /// @param may_be_free whether a component may be the word 'free'
    FaceExpression(const std::string &name,
                   const std::string &expressions,
                   const Constants   &constants,
                   bool               may_be_free);

    /// Whether a component is prescribed.
    bool
    prescribes(const unsigned int component) const
    {
      return is_prescribed_[component];
    }

    /// Return component @p component at @p x, m, time @p t, s. Throws ExcPoint
    /// if the value is not finite.
    double
    value(const dealii::Point<dim> &x,
          const double              t,
          const unsigned int        component)
    {
      return expression_.finite_value(x, t, component);
    }

  private:
    std::array<bool, dim> is_prescribed_;
    Expression<dim>       expression_;
  };
} // namespace talus

#endif

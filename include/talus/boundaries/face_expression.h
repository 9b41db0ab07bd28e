// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_boundaries_face_expression_h
#define talus_boundaries_face_expression_h

#include <talus/base/expression.h>

#include <array>
#include <string>

namespace talus
{
  /// What the user prescribes on a face of the mesh as a function of place and
  /// time, component by component; some components may be left free.
  template <int dim>
  class FaceExpression
  {
  public:
    /// @p name of the parameter, for messages, and what it says: expressions
    /// separated by semicolons, or, if that @p may_be_free, the word 'free' for
    /// a component. Throws ExcUser if it cannot be understood.
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

    /// Throws ExcPoint if it is not finite.
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

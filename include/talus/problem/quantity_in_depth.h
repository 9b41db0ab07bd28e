// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_problem_quantity_in_depth_h
#define talus_problem_quantity_in_depth_h

#include <talus/geometry/place_expression.h>
#include <talus/problem/inputs.h>
#include <talus/problem/mudline.h>
#include <talus/problem/time_table.h>

#include <optional>
#include <string>

namespace talus
{
  /// Quantity of the soil at its initial place, as the user gives it: a number,
  /// an expression in place, depth and surfaces, or `table FILE` with rows of
  /// depth and quantity.
  template <int dim>
  class QuantityInDepth
  {
  public:
    using Variables = typename PlaceExpression<dim>::Variables;

    /// Parse @p words, the value of the parameter @p path. @p column of a table
    /// is name and unit, as "undrained shear strength [Pa]". Throws ExcUser.
    /// @param mudline must outlive the object
    QuantityInDepth(const std::string  &path,
                    const std::string  &words,
                    const std::string  &column,
                    const Inputs<dim>  &inputs,
                    const Mudline<dim> &mudline,
                    Variables           variables = Variables::space_and_depth);

    // The expression refers to this object.
    QuantityInDepth(const QuantityInDepth &) = delete;

    /// Return the value if it is a constant number.
    std::optional<double>
    number() const
    {
      return expression_ ? expression_->number() : std::nullopt;
    }

    /// Return the value at the initial place @p x, m; @p overburden is the
    /// variable of this name, Pa.
    double
    at(const dealii::Point<dim> &x, const double overburden = 0.) const
    {
      return table_ ? table_->value(0, mudline_.depth(x))
                    : expression_->at(x, overburden);
    }

  private:
    const Mudline<dim>                 &mudline_;
    std::optional<TimeTable>            table_;
    std::optional<PlaceExpression<dim>> expression_; ///< unless a table
  };



  /// Return the name of the file if @p words are `table FILE`, otherwise
  /// nothing.
  std::string
  name_of_table(const std::string &words);

  /// Return the checked table @p file of @p column in rows of depth: an invalid
  /// or endless file is found before a resumed run asks for the checksum.
  TimeTable
  table_in_depth(const std::filesystem::path &file, const std::string &column);
} // namespace talus

#endif

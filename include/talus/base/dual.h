// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_base_dual_h
#define talus_base_dual_h

#include <array>
#include <cmath>

namespace talus
{
  /// Number with derivatives by n variables (forward algorithmic
  /// differentiation). A formula templated on Number and called with Dual gives
  /// its derivatives, exact to round-off.
  ///
  /// Trilinos' Sacado is similar, but its operators return expressions that
  /// refer to temporaries, which breaks `auto` and `? :` in our formulas.
  template <unsigned int n>
  struct Dual
  {
    double                value = 0.;
    std::array<double, n> derivative{};

    Dual() = default;

    Dual(const double v)
      : value(v)
    {}

    /// Chain rule: result of a function with value @p v and derivative @p slope
    /// at this number.
    Dual
    chain(const double v, const double slope) const
    {
      Dual result(v);
      for (unsigned int i = 0; i < n; ++i)
        result.derivative[i] = slope * derivative[i];
      return result;
    }

    Dual &
    operator+=(const Dual &b)
    {
      value += b.value;
      for (unsigned int i = 0; i < n; ++i)
        derivative[i] += b.derivative[i];
      return *this;
    }

    Dual &
    operator-=(const Dual &b)
    {
      return *this += -b;
    }

    Dual &
    operator*=(const Dual &b)
    {
      for (unsigned int i = 0; i < n; ++i)
        derivative[i] = derivative[i] * b.value + value * b.derivative[i];
      value *= b.value;
      return *this;
    }

    Dual &
    operator/=(const Dual &b)
    {
      value /= b.value;
      for (unsigned int i = 0; i < n; ++i)
        derivative[i] = (derivative[i] - value * b.derivative[i]) / b.value;
      return *this;
    }

    friend Dual
    operator-(const Dual &a)
    {
      return a.chain(-a.value, -1.);
    }

    friend Dual
    operator+(Dual a, const Dual &b)
    {
      return a += b;
    }

    friend Dual
    operator-(Dual a, const Dual &b)
    {
      return a -= b;
    }

    friend Dual
    operator*(Dual a, const Dual &b)
    {
      return a *= b;
    }

    friend Dual
    operator/(Dual a, const Dual &b)
    {
      return a /= b;
    }

    friend bool
    operator<(const Dual &a, const Dual &b)
    {
      return a.value < b.value;
    }

    friend bool
    operator>(const Dual &a, const Dual &b)
    {
      return a.value > b.value;
    }

    /// At zero the infinite slope is replaced by zero, which is correct for
    /// lengths of vectors multiplied by zero elsewhere in the formula.
    friend Dual
    sqrt(const Dual &a)
    {
      const double root = std::sqrt(a.value);
      return a.chain(root, root > 0. ? 0.5 / root : 0.);
    }

    friend Dual
    log(const Dual &a)
    {
      return a.chain(std::log(a.value), 1. / a.value);
    }

    friend Dual
    sin(const Dual &a)
    {
      return a.chain(std::sin(a.value), std::cos(a.value));
    }

    friend Dual
    cos(const Dual &a)
    {
      return a.chain(std::cos(a.value), -std::sin(a.value));
    }

    friend Dual
    asin(const Dual &a)
    {
      return a.chain(std::asin(a.value),
                     1. / std::sqrt(1. - a.value * a.value));
    }

    friend Dual
    exp(const Dual &a)
    {
      const double v = std::exp(a.value);
      return a.chain(v, v);
    }
  };



  /// Value without derivatives; numbers of other kinds have none.
  template <unsigned int n>
  double
  value_of(const Dual<n> &x)
  {
    return x.value;
  }

  template <typename Number>
  Number
  value_of(const Number &x)
  {
    return x;
  }
} // namespace talus

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
// Counts the floating-point operations of the formulas, by evaluating them with
// a number that counts. Not a measurement of time: the counter "operations" is
// what matters.

#include <talus/materials/von_mises_kernel.h>
#include <talus/points/points.h>
#include <talus/points/step_workspace.h>
#include <talus/transfer/weights_kernel.h>

#include <benchmark/benchmark.h>

namespace talus
{
  /// A double that counts what is done with it: additions, multiplications,
  /// divisions, roots and comparisons as one each. A change of sign is none, as
  /// it becomes part of another instruction.
  struct Counted
  {
    double               value;
    static unsigned long n_operations;

    Counted() = default;

    Counted(const double value)
      : value(value)
    {}

    static Counted
    load(const double *from)
    {
      return *from;
    }

    void
    store(double *to) const
    {
      *to = value;
    }
  };

  unsigned long Counted::n_operations = 0;

  inline Counted
  counted(const double value)
  {
    ++Counted::n_operations;
    return {value};
  }

#define TALUS_OPERATOR(op)                              \
  inline Counted operator op(Counted a, Counted b)      \
  {                                                     \
    return counted(a.value op b.value);                 \
  }                                                     \
  inline Counted operator op(Counted a, double b)       \
  {                                                     \
    return counted(a.value op b);                       \
  }                                                     \
  inline Counted operator op(double a, Counted b)       \
  {                                                     \
    return counted(a op b.value);                       \
  }                                                     \
  inline Counted &operator op##=(Counted &a, Counted b) \
  {                                                     \
    return a = a op b;                                  \
  }                                                     \
  inline Counted &operator op##=(Counted &a, double b)  \
  {                                                     \
    return a = a op b;                                  \
  }
  TALUS_OPERATOR(+)
  TALUS_OPERATOR(-)
  TALUS_OPERATOR(*)
  TALUS_OPERATOR(/)
#undef TALUS_OPERATOR

  inline Counted
  operator-(const Counted a)
  {
    return {-a.value};
  }

  inline bool
  operator>(const Counted a, const Counted b)
  {
    return counted(a.value - b.value).value > 0;
  }

  inline bool
  operator<(const Counted a, const Counted b)
  {
    return b > a;
  }

  inline Counted
  sqrt(const Counted x)
  {
    return counted(std::sqrt(x.value));
  }

  inline Counted
  log(const Counted x)
  {
    return counted(std::log(x.value));
  }
} // namespace talus

namespace
{
  using namespace talus;

  /// A point of volume one that is strained a little.
  template <int dim>
  struct StrainedPoint
  {
    Points<dim>        points;
    StepWorkspace<dim> workspace;

    StrainedPoint()
    {
      points.append(1);
      workspace.reinit(0, 1);
      points.data(points.reference_volume)[0] = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          points.data(points.edges, d * (dim + 1))[0] = 1.;
          for (unsigned int e = 0; e < dim; ++e)
            workspace.velocity_gradient(d, e)[0] = 1e-3 * (1. + d + 2. * e);
        }
    }
  };



  /// Box in the cell and its weights along one axis.
  void
  weights_along_axis()
  {
    StrainedPoint<2> point;
    const auto      &points = point.points;
    BoxShape         shape;
    const Counted    inverse_size{1.};
    const Counted    half =
      half_length_in_cells<2, Counted>(points, shape, 0, 0, inverse_size);
    const Counted x = load<Counted>(points.data(points.position));
    const auto    w = axis_weights((x - Counted{0.}) * inverse_size, half);
    for (const Counted &gradient : w.gradient)
      benchmark::DoNotOptimize(gradient);
  }



  /// A step of the law with @p flow_rule; some column is its plastic variable.
  template <int dim, typename FlowRule>
  void
  step_of_law(const FlowRule &flow_rule)
  {
    StrainedPoint<dim> point;
    StrengthOfPoints   strength;
    strength.softening_column = Points<dim>::generation;
    benchmark::DoNotOptimize(update_rate_law_points<dim, Counted, 1>(
      RateLawStep<dim, FlowRule>{point.points.view(),
                                 point.workspace.view(0, 1),
                                 Points<dim>::generation,
                                 1.,
                                 Moduli{1., 1., 1.},
                                 flow_rule,
                                 strength},
      0));
  }



  template <int dim>
  void
  elastic_stress()
  {
    step_of_law<dim>(NoFlow());
  }



  template <int dim>
  void
  von_mises_stress()
  {
    step_of_law<dim>(VonMisesFlow{1., 0.1, 1.});
  }



  template <int dim>
  void
  determinant_of_edges()
  {
    const StrainedPoint<dim> point;
    benchmark::DoNotOptimize(determinant(
      load_matrix<dim, Counted>(point.points, Points<dim>::edges, 0)));
  }



  void
  count(benchmark::State &state, void (*formula)())
  {
    for (auto _ : state)
      {
        Counted::n_operations = 0;
        formula();
      }
    state.counters["operations"] = Counted::n_operations;
  }



  [[maybe_unused]] const bool operations_registered = []() {
    const auto add = [](const std::string &name, void (*formula)()) {
      benchmark::RegisterBenchmark(("operations/" + name).c_str(),
                                   count,
                                   formula)
        ->Iterations(1);
    };
    add("weights along an axis", weights_along_axis);
    add("determinant, 2-D", determinant_of_edges<2>);
    add("determinant, 3-D", determinant_of_edges<3>);
    add("linear elastic, 2-D", elastic_stress<2>);
    add("linear elastic, 3-D", elastic_stress<3>);
    add("von Mises, 2-D", von_mises_stress<2>);
    add("von Mises, 3-D", von_mises_stress<3>);
    return true;
  }();
} // namespace

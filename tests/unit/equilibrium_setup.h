// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef talus_tests_unit_equilibrium_setup_h
#define talus_tests_unit_equilibrium_setup_h

#include <talus/equilibrium/equilibrium.h>

#include "ranks_setup.h"

namespace
{
  /// Of an elastic material.
  const std::string stiff =
    "set Young's modulus = 1e6\nset Poisson's ratio = 0.3\n";



  /// Parameters of a material.
  inline std::string
  material(const std::string &name, const std::string &entries)
  {
    return in_section("Materials", in_section(name, entries));
  }



  /// All rooms up to the search for equilibrium. Body b is made of the b-th
  /// material.
  template <int dim>
  struct Statics : Core<dim>
  {
    using Base = Core<dim>;
    using Base::boundaries;
    using Base::grid;
    using Base::loads;
    using Base::nodes;
    using Base::points;
    using Base::transfer;
    using Base::workspace;

    static constexpr double density = 1500.; ///< kg/m^3

    Statics(const std::string               &below,
            const std::vector<MaterialName> &names,
            const std::string               &own,
            const MPI_Comm                   communicator   = MPI_COMM_WORLD,
            const std::vector<std::string>  &obstacle_names = {})
      : Base(below, {}, communicator)
      , materials(names)
      , obstacles(obstacle_names)
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(own);
      dealii::ParameterAcceptor::parse_all_parameters();
      std::vector<std::string> bodies;
      for (const MaterialName &name : names)
        bodies.push_back(name.name);
      materials.assign(bodies, bodies);
      materials.add_columns(points);
      boundaries.parse(Constants());
      obstacles.prepare(Constants());
      contact.prepare(grid);
    }

    /// The part [@p lower, @p upper] filled with @p n points along each axis
    /// whose boxes tile it; this rank keeps those in its cells.
    void
    fill(const Point<dim>                    &lower,
         const Point<dim>                    &upper,
         const std::array<unsigned int, dim> &n,
         const unsigned int                   body = 0)
    {
      unsigned int n_all = 1;
      for (unsigned int d = 0; d < dim; ++d)
        n_all *= n[d];
      for (unsigned int k = 0; k < n_all; ++k)
        {
          Point<dim>     x;
          Tensor<1, dim> length;
          unsigned int   rest   = k;
          double         volume = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              length[d] = (upper[d] - lower[d]) / n[d];
              x[d]      = lower[d] + (rest % n[d] + 0.5) * length[d];
              rest /= n[d];
              volume *= length[d];
            }
          if (grid.find_cell(x) >= grid.n_owned_cells())
            continue;
          const unsigned int p        = this->add(x, length, body);
          points.data(points.mass)[p] = density * volume;
          points.data(points.id)[p]   = n_before + k;
        }
      n_before += n_all;
    }

    /// Sort the points in and let weight act.
    void
    load(const Tensor<1, dim> &gravity)
    {
      for (unsigned int p = 0; p < points.size(); ++p)
        materials.of_body(points.data(points.body)[p])
          .initialize(points, p, p + 1);
      boundaries.prepare(grid);
      contact.prepare(grid);
      for (auto &acceleration : loads.acceleration_of_body)
        acceleration = gravity;
      this->constants.mass_cutoff =
        transfer.mass_cutoff(density, grid.finest_size());
      this->sort();
    }

    StaticProblem<dim>
    problem()
    {
      return {*this, transfer, materials, boundaries, loads, contact, mudline};
    }

    /// Search until the end. Returns whether equilibrium is found; residuals by
    /// run of Newton's method are in @p runs.
    bool
    find()
    {
      runs.clear();
      equilibrium.begin(equilibrium.options());
      while (!equilibrium.is_balanced())
        {
          StaticProblem<dim> all = problem();
          if (!equilibrium.advance(all,
                                   [&](const EquilibriumProgress &progress) {
                                     if (progress.iteration.number == 0)
                                       runs.emplace_back();
                                     runs.back().push_back(progress.iteration);
                                     return true;
                                   }))
            return false;
        }
      return true;
    }

    /// Force out of balance at a node after sum_forces(), N.
    Tensor<1, dim>
    force(const unsigned int node) const
    {
      return nodes.force(node);
    }

    Materials<dim>                            materials;
    Obstacles<dim>                            obstacles;
    Contact<dim>                              contact{obstacles, boundaries};
    Equilibrium<dim>                          equilibrium;
    std::function<double(const Point<dim> &)> mudline; ///< see StaticProblem
    unsigned int                              n_before = 0;
    std::vector<std::vector<NewtonIteration>> runs;
  };



  /// Unknowns of the points as they are, none of them held, and what goes with
  /// them.
  template <int dim>
  struct StepParts
  {
    Unknowns<dim>           unknowns;
    ShapeFunctionCache<dim> weights;
    InternalForces<dim>     internal_forces;

    StepParts(Statics<dim> &statics, const double mass_cutoff = 0.)
    {
      StaticProblem<dim> problem = statics.problem();
      sum_forces(problem);
      unknowns.number(statics.nodes, statics.grid, mass_cutoff);
      weights.compute(statics.points,
                      statics.grid,
                      statics.transfer.box_shape(),
                      unknowns);
      unknowns.constrain(
        std::vector<unsigned char>(statics.grid.n_owned_nodes(), 0));
    }

    /// A field with random components at the nodes with unknowns.
    std::vector<double>
    random_field(Statics<dim> &statics, const double size) const
    {
      auto field = unknowns.field();
      for (const unsigned int node : unknowns.active_nodes())
        for (unsigned int d = 0; d < dim; ++d)
          field[dim * node + d] = statics.number(-size, size);
      return field;
    }

    /// Make an empty matrix with room for all couplings.
    void
    make_full(StiffnessMatrix<dim> &matrix) const
    {
      std::vector<unsigned int> nodes;
      for (unsigned int node = 0; node < unknowns.field().size() / dim; ++node)
        if (unknowns.is_active(node))
          nodes.push_back(node);
      matrix.begin_pattern(unknowns);
      matrix.couple(nodes);
      matrix.finish_pattern();
    }

    std::vector<double>
    multiply(const dealii::TrilinosWrappers::SparseMatrix &matrix,
             const std::vector<double>                    &field) const
    {
      dealii::TrilinosWrappers::MPI::Vector x(unknowns.owned(),
                                              unknowns.communicator());
      auto                                  y = x;
      unknowns.for_each_free_dof(
        [&](const unsigned int node, const unsigned int d) {
          x(unknowns.first(node) + d) = field[dim * node + d];
        });
      x.compress(dealii::VectorOperation::insert);
      // Not vmult(): a template of deal.II whose name clang mangles otherwise.
      matrix.trilinos_matrix().Multiply(false,
                                        x.trilinos_vector(),
                                        y.trilinos_vector());
      auto result = unknowns.field();
      unknowns.for_each_free_dof(
        [&](const unsigned int node, const unsigned int d) {
          result[dim * node + d] = y(unknowns.first(node) + d);
        });
      return result;
    }
  };



  inline double
  dot(const std::vector<double> &a, const std::vector<double> &b)
  {
    double sum = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      sum += a[i] * b[i];
    return sum;
  }



  inline double
  largest(const std::vector<double> &a)
  {
    double result = 0.;
    for (const double value : a)
      result = std::max(result, std::abs(value));
    return result;
  }



  /// a + factor b
  inline std::vector<double>
  plus(std::vector<double> a, const double factor, const std::vector<double> &b)
  {
    for (unsigned int i = 0; i < a.size(); ++i)
      a[i] += factor * b[i];
    return a;
  }
} // namespace

#endif

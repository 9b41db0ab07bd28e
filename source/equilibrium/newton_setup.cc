// The part of Newton that sets up the unknowns of a load step.

#include <talus/equilibrium/newton.h>
#include <talus/grid/node_places.h>

#include <deal.II/base/mpi.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <cmath>

namespace talus
{
  using namespace dealii;

  namespace
  {
    /// Largest shear modulus of the bodies, Pa.
    template <int dim>
    double
    largest_shear_modulus(const StaticProblem<dim> &problem)
    {
      double result = 0;
      for (const Segment &segment : problem.state.points.segments())
        result =
          std::max(result,
                   problem.materials.of_body(segment.body).shear_modulus());
      return Utilities::MPI::max(result, problem.state.grid.communicator());
    }
  } // namespace



  /// All that does not change within a load step: unknowns, weights, faces of
  /// the stabilization, pattern of the matrix, rigid modes, and the forces at u
  /// = 0. The order matters: the nodal sums tell which nodes have enough mass
  /// for unknowns; weights, faces and contact know their nodes by these; the
  /// pattern needs all three. A pattern per load step costs little against the
  /// matrices of its iterations, and with large strain points touch other nodes
  /// in each. Collective.
  template <int dim>
  void
  Newton<dim>::begin(StaticProblem<dim> &problem, const Parameters &parameters)
  {
    parameters_      = parameters;
    internal_forces_ = InternalForces<dim>(parameters.measure);
    places_          = places_of_owned_nodes(problem.state.grid);
    extent_          = problem.state.grid.domain().lower.distance(
      problem.state.grid.domain().upper);
    sum_forces(problem);
    unknowns_.number(problem.state.nodes,
                     problem.state.grid,
                     problem.state.mass_cutoff);
    weights_.compute(problem.state.points,
                     problem.state.grid,
                     problem.transfer.box_shape(),
                     unknowns_);
    ghost_.find_faces(problem.state.grid,
                      unknowns_,
                      parameters.ghost_penalty,
                      largest_shear_modulus(problem));
    contact_.begin(problem, unknowns_);
    unknowns_.constrain(contact_.constrained(problem, unknowns_));
    make_pattern();
    make_rigid_modes(problem.state.grid);

    u_ = last_correction_ = unknowns_.field();
    mechanism_.resize(u_.size(), 0.);
    internal_   = unknowns_.field();
    unbalanced_ = unknowns_.field();
    // Without displacements no point can be turned inside out.
    internal_forces_.evaluate(problem, weights_, u_, internal_);
    unknowns_.add_to_owners(internal_);
    double external = 0, internal = 0;
    for (const unsigned int node : unknowns_.active_nodes())
      {
        const Tensor<1, dim> force = problem.state.nodes.force(node);
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int i = dim * node + d;
            unbalanced_[i]       = force[d];
            // Held components count here, too: most of the weight of soil on a
            // seabed is borne there, and free nodes alone may have next to
            // nothing to compare with.
            internal += internal_[i] * internal_[i];
            external += std::pow(unbalanced_[i] + internal_[i], 2);
          }
      }
    // The larger of loads and stress: soil without weight may have a stress,
    // and soil that is not yet stressed has loads.
    reference_ = std::sqrt(std::max(
      Utilities::MPI::sum(internal, problem.state.grid.communicator()),
      Utilities::MPI::sum(external, problem.state.grid.communicator())));
  }



  /// All unknowns that the points of a cell touch are coupled. Held ones keep
  /// their places: nodes of the seabed begin to stick or slip within a load
  /// step, and the pattern serves all its matrices. Rows of other ranks' nodes
  /// are sent to them by compress(). Collective.
  template <int dim>
  void
  Newton<dim>::make_pattern()
  {
    // Trilinos' own pattern: deal.II's function that makes a matrix from a
    // DynamicSparsityPattern is no inline one, and clang has another name for it
    // than GCC, which compiled deal.II.
    TrilinosWrappers::SparsityPattern    pattern(unknowns_.owned(),
                                              unknowns_.owned(),
                                              unknowns_.relevant(),
                                              unknowns_.communicator());
    std::vector<types::global_dof_index> indices;
    for (unsigned int c = 0; c < weights_.cells().size(); ++c)
      {
        const auto patch = weights_.patch(c);
        indices.clear();
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            indices.push_back(unknowns_.first(patch.nodes[a]) + d);
        unknowns_.constraints().add_entries_local_to_global(indices,
                                                            pattern,
                                                            true);
      }
    ghost_.add_to_pattern(unknowns_, pattern);
    pattern.compress();
    matrix_.reinit(pattern);
  }



  /// Translations and rotations about the axes, seen from the lower corner.
  /// In the order of this rank's unknowns, as ML wants them. The origin is the
  /// corner of the mesh, on all ranks the same: rotations about different
  /// points would be different modes.
  template <int dim>
  void
  Newton<dim>::make_rigid_modes(const Grid<dim> &grid)
  {
    modes_.assign(dim == 2 ? 3 : 6, {});
    for (const unsigned int node : unknowns_.active_nodes())
      {
        const Tensor<1, dim> x = places_[node] - grid.domain().lower;
        for (unsigned int d = 0; d < dim; ++d)
          {
            for (unsigned int e = 0; e < dim; ++e)
              modes_[e].push_back(d == e ? 1. : 0.);
            // In the plane of axes a and b.
            unsigned int mode = dim;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = a + 1; b < dim; ++b)
                modes_[mode++].push_back(d == a ? -x[b] : d == b ? x[a] : 0.);
          }
      }
  }



#define INSTANTIATE(dim)                                                      \
  template void Newton<dim>::begin(StaticProblem<dim> &, const Parameters &); \
  template void Newton<dim>::make_pattern();                                  \
  template void Newton<dim>::make_rigid_modes(const Grid<dim> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace talus

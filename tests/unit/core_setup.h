// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef core_setup_h
#define core_setup_h

#include <talus/adaptivity/splitter.h>
#include <talus/base/errors.h>
#include <talus/boundaries/boundaries.h>
#include <talus/state/state.h>
#include <talus/transfer/box_rule.h>
#include <talus/transfer/relocation.h>
#include <talus/transfer/transfer.h>
#include <talus/transfer/weights.h>

#include <deal.II/base/parameter_acceptor.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <string>
#include <vector>

/// Parameters of dead objects must be gone before new ones are declared; a base
/// class, so that it is done before the members are made. One Core at a time.
struct FreshParameters
{
  FreshParameters()
  {
    dealii::ParameterAcceptor::clear();
  }
};



/// Which of the sums at a node is where in NodeSums.
template <int dim>
struct SumIndex
{
  static constexpr unsigned int mass      = 0;              ///< kg
  static constexpr unsigned int volume    = 1;              ///< m^dim
  static constexpr unsigned int momentum  = 2;              ///< kg m/s
  static constexpr unsigned int force     = momentum + dim; ///< N
  static constexpr unsigned int n_entries = force + dim;
};



/// What the points sent to a node, as numbers in a row: most tests do the same
/// with all of them.
template <int dim>
using NodeSums = std::array<double, SumIndex<dim>::n_entries>;



template <int dim>
NodeSums<dim>
sums_of_node(const talus::NodalFields<dim> &nodes, const unsigned int node)
{
  using Index = SumIndex<dim>;
  NodeSums<dim> sums;
  sums[Index::mass]   = nodes.mass(node);
  sums[Index::volume] = nodes.volume(node);
  for (unsigned int d = 0; d < dim; ++d)
    {
      sums[Index::momentum + d] = nodes.momentum(node)[d];
      sums[Index::force + d]    = nodes.force(node)[d];
    }
  return sums;
}



/// All rooms below the materials, and some points.
template <int dim>
struct Core : FreshParameters, talus::State<dim>
{
  using talus::State<dim>::grid;
  using talus::State<dim>::nodes;
  using talus::State<dim>::points;
  using talus::State<dim>::workspace; // of all points

  using Vector = dealii::Tensor<1, dim>;
  using Tensor = dealii::Tensor<2, dim>;

  /// @param text parameters, as in a file
  explicit Core(const std::string              &text,
                const std::array<bool, 2 *dim> &may_move     = {},
                const MPI_Comm                  communicator = MPI_COMM_WORLD)
    : talus::State<dim>(communicator)
    , undeformed_length(points.add_column("undeformed length",
                                          "m",
                                          talus::ColumnKind::vector,
                                          talus::Inheritance::copied))
    , random(4711)
  {
    dealii::ParameterAcceptor::declare_all_parameters();
    dealii::ParameterAcceptor::prm.parse_input_from_string(text);
    dealii::ParameterAcceptor::parse_all_parameters();
    grid.check();
    grid.create(may_move, false, boundaries.periodic_axes());
    grid.refine();
    grid.prepare();
    nodes.prepare(grid);
    loads.acceleration_of_body.resize(3);
    transfer.use_bbar({false, false, false});
    std::array<double, 2 * dim> half;
    half.fill(0.5);
    relocation.allow_outside(half);
  }

  /// Refine once all cells whose centre fulfils @p condition.
  template <typename Condition>
  void
  refine(const Condition &condition)
  {
    for (const auto &cell : grid.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && condition(cell->center()))
        cell->set_refine_flag();
    grid.triangulation().execute_coarsening_and_refinement();
    grid.prepare();
    nodes.prepare(grid);
  }

  /// A number in [lower, upper).
  double
  number(const double lower, const double upper)
  {
    return std::uniform_real_distribution<double>(lower, upper)(random);
  }

  /// A vector with components in [lower, upper).
  Vector
  vector(const double lower, const double upper)
  {
    Vector result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = number(lower, upper);
    return result;
  }

  Tensor
  tensor(const double lower, const double upper)
  {
    Tensor result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = vector(lower, upper);
    return result;
  }

  /// A place in the mesh, @p margin away from its faces.
  dealii::Point<dim>
  place(const double margin = 0)
  {
    dealii::Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = number(grid.domain().lower[d] + margin,
                    grid.domain().upper[d] - margin);
    return x;
  }

  void
  set(const unsigned int column, const unsigned int p, const Vector &value)
  {
    for (unsigned int d = 0; d < dim; ++d)
      points.data(column, d)[p] = value[d];
  }

  Vector
  get(const unsigned int column, const unsigned int p) const
  {
    Vector value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = points.data(column, d)[p];
    return value;
  }

  void
  set(const unsigned int column, const unsigned int p, const Tensor &value)
  {
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        points.data(column, dim * i + j)[p] = value[i][j];
  }

  /// Edges of the cell of point @p p as columns, m.
  Tensor
  edges(const unsigned int p) const
  {
    Tensor A;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        A[i][j] = points.data(points.edges, dim * i + j)[p];
    return A;
  }

  /// Set the edges to F diag(L) with the undeformed lengths L, and F itself if
  /// a law needs it. The box stays what it is.
  void
  set_deformation(const unsigned int p, const Tensor &F)
  {
    const Vector length = get(undeformed_length, p);
    Tensor       A      = F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        A[i][k] *= length[k];
    set(points.edges, p, A);
    for (const talus::Column &column : points.columns())
      if (column.name == "deformation gradient")
        set(column.first, p, F);
  }

  /// F by the edges: of the undeformed cell that add() made, also after splits
  /// and after a reduction of the edges.
  Tensor
  deformation(const unsigned int p) const
  {
    const Vector length = get(undeformed_length, p);
    Tensor       F      = edges(p);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        F[i][k] /= length[k];
    return F;
  }

  /// Stretch the cell and the box of point @p p along axis @p d.
  void
  stretch(const unsigned int p, const unsigned int d, const double factor)
  {
    for (unsigned int k = 0; k < dim; ++k)
      points.data(points.edges, dim * d + k)[p] *= factor;
    points.data(points.box_length, d)[p] *= factor;
  }

  double
  volume(const unsigned int p) const
  {
    return determinant(edges(p));
  }

  /// Cauchy stress, the part within the dimensions of the mesh.
  Tensor
  stress(const unsigned int p) const
  {
    Tensor sigma;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        sigma[i][j] =
          points.data(points.stress, talus::stress_index<dim>(i, j))[p];
    return sigma;
  }

  Tensor
  velocity_gradient(const unsigned int p) const
  {
    Tensor L;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        L[i][j] = workspace.velocity_gradient(i, j)[p];
    return L;
  }

  /// A point at rest, undeformed, with a box of these lengths.
  unsigned int
  add(const dealii::Point<dim> &x,
      const Vector             &length,
      const unsigned int        body = 0)
  {
    const unsigned int p        = points.append(1);
    points.data(points.mass)[p] = 1.;
    points.data(points.id)[p]   = p;
    points.data(points.body)[p] = body;
    set(points.position, p, x);
    set(points.initial_position, p, x);
    set_undeformed(p, length);
    splitter.number_from(points.size(), 1);
    return p;
  }

  /// Make the cell of point @p p an undeformed box with these lengths.
  void
  set_undeformed(const unsigned int p, const Vector &length)
  {
    set(undeformed_length, p, length);
    set(points.box_length, p, length);
    set(points.length_at_creation, p, length);
    set_deformation(p, Tensor(dealii::unit_symmetric_tensor<dim>()));
    points.data(points.reference_volume)[p] = volume(p);
  }

  /// Give a point a random state of every kind but its place and its box.
  void
  randomize(const unsigned int p)
  {
    points.data(points.mass)[p]             = number(0.5, 2.);
    points.data(points.reference_volume)[p] = number(0.1, 1.);
    points.data(points.elastic_energy)[p]   = number(0., 5.);
    set(points.velocity, p, vector(-1., 1.));
    for (unsigned int c = 0; c < talus::n_stress_components<dim>; ++c)
      points.data(points.stress, c)[p] = number(-100., 100.);
    set_deformation(p,
                    tensor(-0.2, 0.2) +
                      Tensor(dealii::unit_symmetric_tensor<dim>()));
  }

  /// @p n points with random states anywhere in the mesh.
  void
  add_cloud(const unsigned int n, const unsigned int n_bodies = 1)
  {
    for (unsigned int i = 0; i < n; ++i)
      randomize(add(place(), vector(0.05, 1.1), i % n_bodies));
  }

  /// Sort the points in.
  void
  sort()
  {
    relocation.update(points, grid);
    workspace.points_out_of_cell().clear();
    nodes.activate(grid, relocation.occupied_cells());
  }

  /// Gather for all points. Returns the work of the loads, J.
  double
  gather(const double dt)
  {
    workspace.reinit(0, points.size());
    return transfer.gather(this->with(loads), points.all(), dt);
  }

  /// Find and split what violates the criterion, once.
  bool
  split()
  {
    splitter.prepare(transfer.box_shape());
    splitter.mark(points, points.all(), grid);
    return splitter.split_marked(points, workspace.points_out_of_cell());
  }

  /// The sums at all nodes of the mesh, hanging nodes condensed; from nothing,
  /// whatever was active before.
  std::vector<NodeSums<dim>>
  scatter()
  {
    nodes.prepare(grid);
    nodes.activate(grid, relocation.occupied_cells());
    scatter_points();
    nodes.sum_over_ranks(grid);
    return sums_of_nodes();
  }

  /// Add what all points send to the nodes.
  void
  scatter_points()
  {
    workspace.reinit(0, points.size());
    transfer.apply_bbar_to_stress(points, workspace, points.all());
    transfer.scatter(this->with(loads), points.all());
  }

  /// The sums at all nodes of the mesh as they are.
  std::vector<NodeSums<dim>>
  sums_of_nodes() const
  {
    std::vector<NodeSums<dim>> sums(grid.n_nodes());
    for (unsigned int n = 0; n < grid.n_nodes(); ++n)
      sums[n] = sums_of_node(nodes, n);
    return sums;
  }

  talus::Transfer<dim>   transfer;
  talus::Boundaries<dim> boundaries;
  talus::Splitter<dim>   splitter;
  talus::Relocation<dim> relocation;
  talus::Loads<dim>      loads;
  /// Column of the lengths L of the undeformed edges, m, which go where their
  /// point goes. Splits do not halve them.
  const unsigned int undeformed_length;
  std::mt19937       random;
};



/// Parameters of a mesh.
inline std::string
mesh(const std::string &lower,
     const std::string &upper,
     const std::string &cell_size = "1")
{
  return "subsection Grid\n set Lower corner = " + lower +
         "\n set Upper corner = " + upper + "\n set Cell size = " + cell_size +
         "\nend\n";
}



inline std::string
in_section(const std::string &name, const std::string &entries)
{
  return "subsection " + name + "\n" + entries + "\nend\n";
}



/// A box of 4 cells of 1 m per axis.
template <int dim>
std::string
cube()
{
  return dim == 2 ? mesh("0, 0", "4, 4") : mesh("0, 0, 0", "4, 4, 4");
}



/// The same with the cells below 2 m in x and z (y in 2-D) halved: hanging
/// nodes in the interior and on the faces of the mesh.
template <int dim>
void
refine_corner(Core<dim> &core)
{
  core.refine(
    [](const dealii::Point<dim> &x) { return x[0] < 2. && x[dim - 1] < 2.; });
}



/// Places of the nodes.
template <int dim>
std::vector<dealii::Point<dim>>
places_of_nodes(const talus::Grid<dim> &grid)
{
  std::vector<dealii::Point<dim>> places(grid.n_nodes());
  for (const auto &cell : grid.dof_handler().active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      places[cell->vertex_dof_index(v, 0)] = cell->vertex(v);
  return places;
}



/// What the exception says that @p action throws, on one line; empty if it does
/// not throw.
template <typename Exception, typename Action>
std::string
message_of(const Action &action)
{
  try
    {
      action();
    }
  catch (const Exception &exception)
    {
      std::istringstream words(exception.what());
      std::string        line;
      for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
      return line;
    }
  return "";
}



/// A splitter that splits whatever is longer than 1.5 times its length, along
/// the axes of @p directions. Shear is counted where all axes are split.
inline std::string
splitting_along(const std::string &directions)
{
  return in_section("Splitting",
                    std::string(directions == "all" ? "set Shear = counted\n"
                                                    : "") +
                      "set Minimum length = 0\nset Threshold = 1.5"
                      "\nset Directions = " +
                      directions);
}



inline bool
contains(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}

#endif

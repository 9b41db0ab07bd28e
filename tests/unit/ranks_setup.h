// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ranks_setup_h
#define ranks_setup_h

#include <deal.II/base/mpi.h>

// For all_gather() of such.
#include <boost/serialization/map.hpp>
#include <boost/serialization/set.hpp>

#include "core_setup.h"

// What many ranks must do is what one does: each process does the same work
// alone, on MPI_COMM_SELF, and then with the others, and compares by the
// numbers of nodes, the keys of cells and the ids of points.

namespace
{
  using namespace talus;
  using dealii::Point;
  using dealii::Tensor;
  namespace MPI = dealii::Utilities::MPI;

  /// Several trees, unlike cube().
  template <int dim>
  std::string
  slab()
  {
    return dim == 2 ? mesh("0, 0", "6, 4") : mesh("0, 0, 0", "6, 4, 2");
  }



  /// A number in [0, 1) that depends on place and seed alone, so that all ranks
  /// agree on it.
  template <int dim>
  double
  dice(const Point<dim> &x, unsigned int seed)
  {
    for (unsigned int d = 0; d < dim; ++d)
      seed = 1000003u * seed + static_cast<unsigned int>(64. * x[d] + 0.5);
    std::mt19937 random(seed);
    return std::uniform_real_distribution<double>()(random);
  }



  /// Share the cells out anew, in shares that have nothing to do with soil.
  template <int dim>
  void
  scramble(Core<dim> &core, const unsigned int seed)
  {
    auto      &triangulation = core.grid.triangulation();
    const auto weights       = triangulation.signals.weight.connect(
      [seed](const auto &cell, const auto) -> unsigned int {
        return dice(cell->center(), seed) < 0.1 ? 1000 : 1;
      });
    triangulation.repartition();
    weights.disconnect();
    core.grid.prepare();
    core.nodes.prepare(core.grid);
  }



  constexpr unsigned int n_kinds_of_mesh = 4;

  /// Uniform; one plane of hanging nodes; smaller cells in a corner of these;
  /// small cells anywhere.
  template <int dim>
  void
  make_mesh(Core<dim> &core, const unsigned int kind, const unsigned int seed)
  {
    if (kind == 1 || kind == 2)
      refine_corner(core);
    if (kind == 2)
      core.refine([](const Point<dim> &x) { return x.norm() < 1.1; });
    for (unsigned int i = 0; kind == 3 && i < 2; ++i)
      core.refine(
        [=](const Point<dim> &x) { return dice(x, 97 * seed + i) < 0.25; });
    scramble(core, seed);
  }



  /// Do something on every kind of mesh, shared out in several ways: alone for
  /// the @p reference, then with the others, to @p compare.
  template <int dim, typename Reference, typename Compare>
  void
  on_all_meshes(const std::string &parameters,
                const Reference   &reference,
                const Compare     &compare)
  {
    for (unsigned int kind = 0; kind < n_kinds_of_mesh; ++kind)
      for (unsigned int seed = 1; seed < (dim == 2 ? 4 : 3); ++seed)
        {
          SCOPED_TRACE(text(dim, "-D, mesh ", kind, ", shares ", seed));
          const auto expected = [&]() {
            Core<dim> alone(slab<dim>() + parameters, {}, MPI_COMM_SELF);
            make_mesh(alone, kind, seed);
            return reference(alone);
          }();
          Core<dim> core(slab<dim>() + parameters);
          make_mesh(core, kind, seed);
          compare(core, expected);
        }
  }



  /// Number over all ranks of a node of this rank.
  template <int dim>
  unsigned long
  number_of_node(const Grid<dim> &grid, const unsigned int node)
  {
    const unsigned int n_owned = grid.n_owned_nodes();
    return node < n_owned ? grid.owned_nodes().nth_index_in_set(node)
                          : grid.ghost_nodes().nth_index_in_set(node - n_owned);
  }



  /// @p n points with random states, the same on any number of ranks, each of
  /// which keeps those in its cells. @p place draws a place.
  template <int dim, typename Place>
  void
  add_shared(Core<dim>         &core,
             const unsigned int n,
             const unsigned int n_bodies,
             const Place       &place)
  {
    for (unsigned int i = 0; i < n; ++i)
      {
        core.random.seed(i + 1);
        const Point<dim>   x = place();
        const unsigned int c = core.grid.find_cell(x);
        if (c >= core.grid.n_owned_cells())
          continue;
        const unsigned int p =
          core.add(x, core.vector(0.05, 1.1), i % n_bodies);
        core.randomize(p);
        core.points.data(core.points.id)[p] = i;
      }
  }



  /// Fill all columns but place, body and id with numbers that tell the point
  /// and the column.
  template <int dim, typename Action>
  void
  for_signed_columns(const Points<dim> &points, const Action &action)
  {
    for (unsigned int array = 0; array < points.n_arrays(); ++array)
      if (!(array >= points.position && array < points.position + dim) &&
          array != points.body && array != points.id)
        action(array);
  }

  template <int dim>
  void
  sign(Points<dim> &points, const unsigned int p)
  {
    for_signed_columns(points, [&](const unsigned int array) {
      points.data(array)[p] = points.data(points.id)[p] + 1e-3 * array;
    });
  }

  template <int dim>
  void
  expect_signed(const Points<dim> &points)
  {
    for (unsigned int p = 0; p < points.size(); ++p)
      for_signed_columns(points, [&](const unsigned int array) {
        EXPECT_EQ(points.data(array)[p],
                  points.data(points.id)[p] + 1e-3 * array);
      });
  }



  /// Sorted by cell and body, each point in an owned cell.
  template <int dim>
  void
  expect_sorted(const Core<dim> &core)
  {
    const auto    &points = core.points;
    unsigned int   end    = 0;
    const Segment *last   = nullptr;
    for (const Segment &segment : points.segments())
      {
        EXPECT_EQ(segment.begin, end);
        EXPECT_LT(segment.begin, segment.end);
        EXPECT_LT(segment.cell, core.grid.n_owned_cells());
        end = segment.end;
        if (last)
          {
            EXPECT_LT(std::tie(last->cell, last->body),
                      std::tie(segment.cell, segment.body));
          }
        last = &segment;
        for (unsigned int p = segment.begin; p < segment.end; ++p)
          {
            EXPECT_EQ(core.grid.find_cell(
                        Point<dim>(core.get(points.position, p))),
                      segment.cell);
            EXPECT_EQ(points.data(points.body)[p], segment.body);
          }
      }
    EXPECT_EQ(end, points.size());
  }
} // namespace

#endif

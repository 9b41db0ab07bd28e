// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef periodic_setup_h
#define periodic_setup_h

#include "ranks_setup.h"

namespace
{
  using Axes2 = std::array<bool, 2>;
  using Axes3 = std::array<bool, 3>;

  /// A mesh of cells of 1 m, @p width of them along the periodic axes and three
  /// along the others; the places below are counted from its lower corner,
  /// which is not the origin.
  template <int dim>
  struct Periodic
  {
    std::array<bool, dim> axes;
    unsigned int          width;

    Lattice<dim>
    extent() const
    {
      Lattice<dim> n;
      for (unsigned int d = 0; d < dim; ++d)
        n[d] = axes[d] ? width : 3;
      return n;
    }

    /// With @p copies of it in a row along its periodic axes.
    std::string
    grid(const long copies = 1) const
    {
      std::string lower, upper;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const std::string comma = (d == 0 ? "" : ", ");
          lower += comma + "-3";
          upper += comma + text(extent()[d] * (axes[d] ? copies : 1) - 3);
        }
      return mesh(lower, upper);
    }

    std::string
    conditions() const
    {
      std::string entries;
      for (unsigned int face = 0; face < 2 * dim; ++face)
        if (axes[face / 2])
          entries += "set " + face_names[face] + " = periodic\n";
      return in_section("Boundaries", entries);
    }

    std::string
    trace() const
    {
      std::string result = text(width, " wide, periodic along");
      for (unsigned int d = 0; d < dim; ++d)
        result += axes[d] ? text(' ', d) : "";
      return result;
    }
  };



  /// Meshes of several widths, periodic along one axis or more.
  template <typename Action>
  void
  on_periodic_meshes(const Action &action)
  {
    for (const unsigned int width : {1, 2, 5})
      {
        for (const Axes2 &axes :
             {Axes2{{true, false}}, Axes2{{false, true}}, Axes2{{true, true}}})
          {
            const Periodic<2> periodic{axes, width};
            SCOPED_TRACE(periodic.trace());
            action(periodic);
          }
        for (const Axes3 &axes : {Axes3{{true, false, false}},
                                  Axes3{{true, false, true}},
                                  Axes3{{true, true, true}}})
          if (width < 5 || !axes[1])
            {
              const Periodic<3> periodic{axes, width};
              SCOPED_TRACE(periodic.trace());
              action(periodic);
            }
      }
  }



  /// Do something for each node of the cells of this rank: its index and the
  /// place in the lattice where the cell has it.
  template <int dim, typename Action>
  void
  for_each_node(const Grid<dim> &grid, const Action &action)
  {
    for (unsigned int c = 0; c < grid.n_owned_cells(); ++c)
      for (unsigned int v = 0; v < power(2, dim); ++v)
        {
          Lattice<dim> place = grid.place_of_cell(c);
          unsigned int at    = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              place[d] += (v >> d) & 1;
              at += (1 + ((v >> d) & 1)) * power(4, d);
            }
          action(grid.cells()[c].patch[at], place);
        }
  }



  template <int dim>
  using SumsByPlace = std::map<Lattice<dim>, NodeSums<dim>>;

  /// Sums at the nodes this rank owns.
  template <int dim>
  SumsByPlace<dim>
  sums_by_place(Core<dim> &core)
  {
    const auto       sums = core.scatter();
    SumsByPlace<dim> result;
    for_each_node(core.grid, [&](const unsigned int node, const auto &place) {
      if (node < core.grid.n_owned_nodes())
        result[place] = sums[node];
    });
    return result;
  }



  /// Points in random states anywhere in the mesh and up to
  /// @p beyond_faces cells beyond its periodic ones, the same on any number of
  /// ranks; each @p copies times along every periodic axis.
  template <int dim>
  void
  add_repeated(Core<dim>           &core,
               const Periodic<dim> &periodic,
               const unsigned int   copies,
               const double         beyond_faces = 0.9)
  {
    const auto   extent = periodic.extent();
    unsigned int n = 4, n_copies = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        n *= extent[d];
        n_copies *= periodic.axes[d] ? copies : 1;
      }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int copy = 0; copy < n_copies; ++copy)
        {
          core.random.seed(i + 1);
          Point<dim>   x;
          unsigned int rest = copy;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double beyond = (periodic.axes[d] ? beyond_faces : 0.);
              const double in =
                core.number(0., 1.) * (extent[d] + 2 * beyond) - beyond;
              x[d] = -3. + in;
              if (periodic.axes[d])
                {
                  x[d] += (rest % copies) * extent[d];
                  rest /= copies;
                }
            }
          const auto length = core.vector(0.05, 1.1);
          bool       is_in  = true;
          for (unsigned int d = 0; d < dim; ++d)
            is_in =
              is_in && (copies == 1 || (x[d] >= core.grid.domain().lower[d] &&
                                        x[d] < core.grid.domain().upper[d]));
          if (!is_in || core.grid.find_cell(x) >= core.grid.n_owned_cells())
            continue;
          const unsigned int p = core.add(x, length, i % 3);
          core.randomize(p);
          core.points.data(core.points.id)[p] = i * n_copies + copy;
        }
    core.transfer.use_bbar({true, false, true});
    core.sort();
  }
} // namespace

#endif

// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_values.h>

#include <set>

#include "core_setup.h"

namespace
{
  using namespace talus;
  using dealii::Point;

  // --------------------------------------------------------------- boundary

  /// Integrals of the shape functions over a face and over the cells at it,
  /// by deal.II, with the hanging nodes condensed.
  template <int dim>
  std::vector<std::pair<double, double>>
  integrate_shares(const Grid<dim> &grid, const unsigned int face)
  {
    const auto                            &dofs = grid.dof_handler();
    const dealii::QGauss<dim>              in_cell(2);
    const dealii::QGauss<dim - 1>          in_face(2);
    dealii::FEValues<dim>                  values(dofs.get_fe(),
                                 in_cell,
                                 dealii::update_values |
                                   dealii::update_JxW_values);
    dealii::FEFaceValues<dim>              face_values(dofs.get_fe(),
                                          in_face,
                                          dealii::update_values |
                                            dealii::update_JxW_values);
    std::vector<std::pair<double, double>> shares(grid.n_nodes());
    for (const auto &cell : dofs.active_cell_iterators())
      if (cell->face(face)->at_boundary())
        {
          values.reinit(cell);
          face_values.reinit(cell, face);
          for (const unsigned int v : cell->vertex_indices())
            {
              auto &share = shares[cell->vertex_dof_index(v, 0)];
              for (const unsigned int q :
                   face_values.quadrature_point_indices())
                share.first +=
                  face_values.shape_value(v, q) * face_values.JxW(q);
              // Only the nodes on the face stand for the volume there.
              if (v / power(2, face / 2) % 2 == face % 2)
                for (const unsigned int q : values.quadrature_point_indices())
                  share.second += values.shape_value(v, q) * values.JxW(q);
            }
        }
    for (const auto &hanging : grid.hanging_nodes())
      {
        for (const auto &[master, weight] : hanging.masters)
          {
            shares[master].first += weight * shares[hanging.node].first;
            shares[master].second += weight * shares[hanging.node].second;
          }
        shares[hanging.node] = {0., 0.};
      }
    return shares;
  }



  template <int dim>
  void
  expect_shares(const Grid<dim> &grid)
  {
    std::set<unsigned int> hanging;
    for (const auto &node : grid.hanging_nodes())
      hanging.insert(node.node);
    const auto places = places_of_nodes(grid);
    for (unsigned int face = 0; face < 2 * dim; ++face)
      {
        const unsigned int d        = face / 2;
        const auto         expected = integrate_shares(grid, face);
        double             area     = 0;
        for (unsigned int n = 0; n < grid.n_nodes(); ++n)
          {
            const double at =
              (face % 2 == 0 ? grid.domain().lower[d] : grid.domain().upper[d]);
            const bool on_face = std::abs(places[n][d] - at) < 1e-12;
            EXPECT_EQ((grid.faces_of_node(n) >> face) & 1, on_face);
            if (on_face && hanging.count(n) == 0)
              {
                const auto &share = grid.face_share(face, n);
                EXPECT_NEAR(share.area, expected[n].first, 1e-14);
                EXPECT_NEAR(share.volume, expected[n].second, 1e-14);
                area += share.area;
              }
            else
              EXPECT_EQ(grid.face_share(face, n).area, 0.);
          }
        double whole = 1;
        for (unsigned int e = 0; e < dim; ++e)
          whole *= (e == d ? 1. : grid.domain().length(e));
        EXPECT_NEAR(area, whole, 1e-13 * whole);
      }
  }



  template <int dim>
  void
  expect_shares_with_hanging_nodes()
  {
    Core<dim> core(cube<dim>());
    expect_shares(core.grid);
    refine_corner(core);
    EXPECT_FALSE(core.grid.hanging_nodes().empty());
    expect_shares(core.grid);
  }



  TEST(Grid, FaceShares)
  {
    expect_shares_with_hanging_nodes<2>();
    expect_shares_with_hanging_nodes<3>();
    Core<2> sheet(mesh("0, 0", "5, 1"));
    expect_shares(sheet.grid);
  }



  /// A node hangs if it lies on a cell without being one of its corners.
  template <int dim>
  void
  expect_hanging_nodes_by_geometry()
  {
    Core<dim> core(cube<dim>());
    EXPECT_TRUE(core.grid.hanging_nodes().empty());
    refine_corner(core);
    const auto             places = places_of_nodes(core.grid);
    std::set<unsigned int> expected, found;
    for (const auto &cell : core.grid.dof_handler().active_cell_iterators())
      for (unsigned int n = 0; n < places.size(); ++n)
        {
          bool on_cell = true, corner = false;
          for (unsigned int d = 0; d < dim; ++d)
            on_cell = on_cell && places[n][d] > cell->vertex(0)[d] - 1e-12 &&
                      places[n][d] < cell->vertex(power(2, dim) - 1)[d] + 1e-12;
          for (const unsigned int v : cell->vertex_indices())
            corner = corner || cell->vertex_dof_index(v, 0) == n;
          if (on_cell && !corner)
            expected.insert(n);
        }
    for (const auto &hanging : core.grid.hanging_nodes())
      {
        found.insert(hanging.node);
        double     sum = 0;
        Point<dim> mean;
        for (const auto &[master, weight] : hanging.masters)
          {
            sum += weight;
            mean += weight * dealii::Tensor<1, dim>(places[master]);
            EXPECT_EQ(expected.count(master), 0u);
          }
        EXPECT_NEAR(sum, 1., 1e-15);
        EXPECT_LT(mean.distance(places[hanging.node]), 1e-14);
      }
    EXPECT_EQ(found, expected);
  }



  TEST(Grid, HangingNodesByGeometry)
  {
    expect_hanging_nodes_by_geometry<2>();
    expect_hanging_nodes_by_geometry<3>();
  }
} // namespace

// SPDX-License-Identifier: LGPL-2.1-or-later
#include "ranks_setup.h"
#include "suites.h"

#include <talus/contact/facet_coverage.h>

TALUS_ALSO_ON_RANKS(FacetCoverage, 2, 3);

namespace
{
  /// Boxes over a level bed, on all ranks together.
  template <int dim>
  struct BoxesOverBed : Core<dim>
  {
    explicit BoxesOverBed(const double height)
      : Core<dim>(slab<dim>(), {}, MPI_COMM_WORLD)
      , obstacles({"bed"})
      , height(height)
    {
      dealii::ParameterAcceptor::declare_all_parameters();
      dealii::ParameterAcceptor::prm.parse_input_from_string(in_section(
        "Obstacles",
        in_section("bed",
                   "set Shape = " + std::string("half-plane") +
                     "\nset Point = 0, " + std::to_string(height) +
                     (dim == 2 ? "" : ", 0") + "\nset Normal = 0, 1" +
                     (dim == 2 ? "" : ", 0"))));
      dealii::ParameterAcceptor::parse_all_parameters();
      obstacles.prepare(Constants());
    }

    /// A box 0.3 m high, @p gap m above the bed, from @p lower to @p upper
    /// along x, and in 3-D along all of z in boxes of 0.5 m.
    void
    add_box(const double lower, const double upper, const double gap)
    {
      for (double z = 0.25; z < (dim == 2 ? 0.5 : 2.); z += 0.5)
        {
          Point<dim>     x;
          Tensor<1, dim> length;
          x[0]      = 0.5 * (lower + upper);
          x[1]      = height + gap + 0.15;
          length[0] = upper - lower;
          length[1] = 0.3;
          if (dim == 3)
            {
              x[dim - 1]      = z;
              length[dim - 1] = 0.5;
            }
          if (this->grid.find_cell(x) < this->grid.n_owned_cells())
            this->add(x, length);
        }
    }

    /// Covered shares of the facets of all ranks, by the x of their cells.
    std::map<double, double>
    shares(const unsigned int seed)
    {
      scramble(*this, seed);
      facets.prepare(this->grid, obstacles);
      FacetCoverage<dim> coverage(obstacles, facets);
      coverage.prepare(this->grid);
      add_boxes();
      this->sort();
      coverage.find(*this,
                    std::vector<double>(facets.owned().size(), 0.3),
                    std::vector<double>(facets.ghosts().size(), 0.3));
      std::map<double, double> of_rank, all;
      for (unsigned int f = 0; f < facets.owned().size(); ++f)
        {
          const auto &cell = this->grid.cells()[facets.owned()[f].cell];
          // In 3-D both cells along z have the same share.
          const double x = cell.lower[0];
          if (of_rank.count(x) > 0)
            {
              EXPECT_EQ(of_rank[x], coverage[f]) << x;
            }
          of_rank[x] = coverage[f];
        }
      for (const auto &map :
           MPI::all_gather(this->grid.communicator(), of_rank))
        for (const auto &[x, share] : map)
          {
            if (all.count(x) > 0)
              {
                EXPECT_EQ(all[x], share) << x;
              }
            all[x] = share;
          }
      return all;
    }

    /// Two boxes 0.2 m apart, a third one 0.55 m away, and one too high above.
    void
    add_boxes()
    {
      add_box(0.6, 1.3, 0.1);
      add_box(1.5, 2.45, 0.);
      add_box(3., 3.7, 0.2);
      add_box(4.1, 5.9, 0.26);
    }

    Obstacles<dim> obstacles;
    Facets<dim>    facets;
    double         height;
  };



  /// Sample points lie at 0.125, 0.375, 0.625, 0.875 of each cell: under the
  /// boxes and in the hole of 0.2 m those from 0.625 to 2.375 are covered, then
  /// those from 3.125 to 3.625. No sample point of the hole of 0.55 m is within
  /// 0.25 m of both of its ends.
  template <int dim>
  void
  expect_shares(const double height)
  {
    const std::map<double, double> expected = {
      {0., 0.5}, {1., 1.}, {2., 0.5}, {3., 0.75}, {4., 0.}, {5., 0.}};
    for (unsigned int seed = 0; seed < 3; ++seed)
      {
        BoxesOverBed<dim> soil(height);
        EXPECT_EQ(soil.shares(seed), expected) << seed;
      }
  }
} // namespace



// The bed in the lower and in the upper part of its cell, where the centres of
// boxes lie in the cell above: on another rank, perhaps.
TEST(FacetCoverage, SamplePointsUnderBoxes)
{
  for (const double height : {1.1, 1.9})
    {
      expect_shares<2>(height);
      expect_shares<3>(height);
    }
}

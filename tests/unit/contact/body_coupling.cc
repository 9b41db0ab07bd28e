// SPDX-License-Identifier: LGPL-2.1-or-later
// Soil that falls onto an obstacle with a mass: the plastic impact, by hand.

#include "soil_on_bed.h"
#include "suites.h"

namespace body_coupling_test
{
  TALUS_ALSO_ON_RANKS(BodyCoupling, 2, 3);

  /// Soil with the velocity @p before, m/s, after a step in contact with a bed
  /// of @p mass, kg.
  template <int dim>
  struct Impact : SoilOnBed<dim>
  {
    Impact(const double          mass,
           const std::string    &entries,
           const Tensor<1, dim> &before)
      : SoilOnBed<dim>("set Mass = " + std::to_string(mass) + "\n" + entries)
      , mass(mass)
      , before(before)
    {
      this->time_step = 0.1;
      this->fill_boxes({0., 2.}, {6., 3.5});
      this->move(before);
      this->contact.find_soil(*this);
      this->contact.correct_velocities(*this);
      this->nodes.share_with_ghosts(this->grid);
      this->contact.record(*this);
    }

    double
    account(const std::string &name) const
    {
      return MPI::sum(this->accounts.energy(name), this->grid.communicator());
    }

    /// Mass of the soil at the nodes of the bed, kg.
    static double
    soil_mass()
    {
      return (dim == 2 ? 6. : 12.) * SoilOnBed<dim>::half_cell;
    }

    /// Expect soil at the bed and bed to have the velocities @p of_soil and
    /// @p of_bed, m/s, and the bed to have its momentum from the soil.
    void
    expect(const Tensor<1, dim> &of_soil, const Tensor<1, dim> &of_bed) const
    {
      const Obstacle<dim> &bed = this->obstacles[0];
      EXPECT_LT((bed.velocity(0.) - of_bed).norm(), 1e-10);
      EXPECT_LT((bed.displacement() - 0.1 * of_bed).norm(), 1e-11);
      this->for_each_node_of_facets(
        [&](const unsigned int node, const Point<dim> &x) {
          if (x[1] < 2.5)
            {
              EXPECT_LT((this->nodes.velocity(node) - of_soil).norm(), 1e-10)
                << x;
            }
        });
      const auto &impulse = this->contact.reactions()[0].last.impulse;
      EXPECT_LT((impulse - soil_mass() * (before - of_soil)).norm(), 1e-6);
      EXPECT_NEAR(impulse[1], mass * of_bed[1], 1e-6);
      const double energy = 0.5 * mass * of_bed.norm_square();
      EXPECT_NEAR(account("obstacle kinetic energy"), energy, 1e-6);
      EXPECT_NEAR(account("work on obstacles"), energy, 1e-6);
    }

    double         mass;   ///< kg
    Tensor<1, dim> before; ///< m/s
  };



  template <int dim>
  void
  expect_impacts()
  {
    const auto v = [](const double x, const double y) {
      return vector_xy<dim>(x, y);
    };
    const double soil = Impact<dim>::soil_mass();
    // From a hundred times lighter than the soil to a hundred times heavier.
    for (const double mass : {0.01 * soil, soil, 100. * soil})
      {
        const double share = soil / (soil + mass);
        Impact<dim>(mass, "set Friction coefficient = 0", v(1., -2.))
          .expect(v(1., -2. * share), v(0., -2. * share));
        // Friction of up to 0.3 of the normal impulse makes the soil stick.
        const std::string rough = "set Friction coefficient = 0.3\n";
        Impact<dim>(mass, rough, v(-0.5, -2.))
          .expect(v(-0.5 * share, -2. * share), v(-0.5 * share, -2. * share));
        // The bed is held along x.
        Impact<dim>(mass, rough + "set Free axes = y", v(-0.1, -2.))
          .expect(v(-0.1 + std::min(0.1, 0.6 * (1 - share)), -2. * share),
                  v(0., -2. * share));
        // A surface only pushes.
        Impact<dim>(mass, rough, v(1., 2.)).expect(v(1., 2.), v(0., 0.));
      }
  }
} // namespace body_coupling_test



TEST(BodyCoupling, PlasticImpact)
{
  body_coupling_test::expect_impacts<2>();
  body_coupling_test::expect_impacts<3>();
}

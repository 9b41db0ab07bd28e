// SPDX-License-Identifier: LGPL-2.1-or-later
// One step of contact: soil that falls onto a bed, with all impulses by hand.

#include "soil_on_bed.h"
#include "suites.h"

namespace contact_test
{
  TALUS_ALSO_ON_RANKS(Contact, 2, 3);

  /// Soil with the initial velocity @p before, m/s, after a step of @p dt, s,
  /// in contact with the bed.
  template <int dim>
  struct Step : SoilOnBed<dim>
  {
    Step(const std::string    &friction,
         const Tensor<1, dim> &before,
         const double          dt     = 0.1,
         const double          height = 0.)
      : SoilOnBed<dim>(friction)
      , before(before)
    {
      this->time_step = dt;
      this->fill_boxes({0., 2. + height}, {6., 3.5 + height});
      this->move(before);
      const double energy_before = energy();
      this->contact.find_soil(*this);
      this->contact.correct_velocities(*this);
      this->nodes.share_with_ghosts(this->grid);
      this->contact.record(*this);
      lost_energy = energy_before - energy();
    }

    double
    energy() const
    {
      return MPI::sum(this->nodes.kinetic_energy(), this->grid.communicator());
    }

    double
    account(const std::string &name) const
    {
      return MPI::sum(this->accounts.energy(name), this->grid.communicator());
    }

    /// Expect each facet to pass @p normal and @p tangential, N s, and the
    /// soil at the bed to have the velocity @p after, m/s.
    void
    expect(const double          normal,
           const double          tangential,
           const Tensor<1, dim> &after) const
    {
      const double n_facets = (dim == 2 ? 6. : 12.);
      for (const ContactImpulse<dim> &impulse : this->contact.impulses())
        {
          EXPECT_NEAR(impulse.normal, normal, 1e-9);
          EXPECT_NEAR(impulse.tangential[0], tangential, 1e-9);
          EXPECT_EQ(impulse.acts(), normal != 0.);
        }
      this->for_each_node_of_facets(
        [&](const unsigned int node, const Point<dim> &x) {
          EXPECT_LT(
            (this->nodes.velocity(node) - (x[1] < 2.5 ? after : before)).norm(),
            1e-12)
            << x;
        });
      const auto &reaction = this->contact.reactions()[0].last;
      EXPECT_NEAR(reaction.impulse[0], -n_facets * tangential, 1e-7);
      EXPECT_NEAR(reaction.impulse[1], -n_facets * normal, 1e-7);
      EXPECT_NEAR(reaction.tangential[0], -n_facets * tangential, 1e-7);
      // The works of the impulses are the energy that the soil has lost.
      EXPECT_NEAR(account("friction work") + account("contact work"),
                  lost_energy,
                  1e-9 * (1. + std::abs(lost_energy)));
    }

    Tensor<1, dim> before;      ///< m/s
    double         lost_energy; ///< J
  };



  template <int dim>
  void
  expect_steps()
  {
    const double m = SoilOnBed<dim>::half_cell;
    const auto   v = [](const double x, const double y) {
      return vector_xy<dim>(x, y);
    };
    // Without friction only the normal velocity changes.
    Step<dim>("set Friction coefficient = 0", v(1., -2.))
      .expect(2. * m, 0., v(1., 0.));
    // The friction impulse is 0.3 of the normal impulse, but at most stops the
    // soil.
    const std::string rough = "set Friction coefficient = 0.3";
    Step<dim>(rough, v(1., -2.)).expect(2. * m, -0.6 * m, v(0.4, 0.));
    Step<dim>(rough, v(-0.5, -2.)).expect(2. * m, 0.5 * m, v(0., 0.));
    // A surface only pushes.
    Step<dim>(rough, v(1., 2.)).expect(0., 0., v(1., 2.));
  }
} // namespace contact_test



TEST(Contact, ImpulsesOfOneStep)
{
  contact_test::expect_steps<2>();
  contact_test::expect_steps<3>();
}



// 0.25 m above the dead band soil may fall at 0.25 m per step.
TEST(Contact, SoilMayApproachByTheGap)
{
  using contact_test::Step;
  const auto fall = Point<2>(0., -2.);
  Step<2>("", fall, 0.1, 0.3).expect(0., 0., fall);
  const Step<2> slowed("", fall, 0.25, 0.3);
  slowed.for_each_node_of_facets(
    [&](const unsigned int node, const Point<2> &x) {
      EXPECT_NEAR(slowed.nodes.velocity(node)[1], x[1] < 2.5 ? -1. : -2., 1e-12)
        << x;
    });
}



// The second step starts from the impulses of the first step, scaled by the
// ratio of the time steps, and, with nothing left to correct, removes the
// impulses sweep by sweep.
TEST(Contact, ImpulsesAreForcesOfThePreviousStep)
{
  contact_test::Step<2> soil("set Friction coefficient = 0", Point<2>(0., -2.));
  // A force of 2 m / 0.1 s for 0.05 s stops soil that falls with 1 m/s.
  soil.time_step = 0.05;
  soil.move(Point<2>(0., -1.));
  soil.contact.find_soil(soil);
  soil.contact.correct_velocities(soil);
  soil.before = Point<2>(0., -1.);
  for (const ContactImpulse<2> &impulse : soil.contact.impulses())
    EXPECT_NEAR(impulse.normal, soil.half_cell, 1e-9);
  EXPECT_EQ(soil.contact.previous_time_step(), 0.05);
}



// Soil is dragged over the bed: friction takes
//   r tau_p s + (1 - r) tau_p s_95/3 (1 - e^(-3 s/s_95))
// per area. Before, it sticks, which is no slip.
TEST(Contact, WorkOfSofteningBySlip)
{
  constexpr double tau = 3500., r = 0.4, s_95 = 0.1;
  const double     dt = 1e-5;

  contact_test::Step<2> soil(
    text("set Friction coefficient = 10\nset Maximum shear stress = ",
         tau,
         "\nset Slip to remould = ",
         s_95,
         "\nset Remoulded shear stress ratio = ",
         r),
    Point<2>(1e-9, -1e-3),
    dt);
  const BedSlip<2> &slip  = soil.contact.slip();
  const auto        s_max = [&]() {
    return slip.largest_slips(2, soil.grid.communicator())[1];
  };
  const double area = 6.;
  EXPECT_EQ(s_max(), 0.);
  double before = soil.account("friction work");
  for (const double end : {0.03, 0.1, 0.2})
    {
      while (s_max() < end)
        {
          soil.move(Point<2>(5., -1e-3));
          soil.contact.find_soil(soil);
          soil.contact.correct_velocities(soil);
          soil.nodes.share_with_ghosts(soil.grid);
          soil.contact.record(soil);
        }
      const double s = s_max();
      const double expected =
        area * (r * tau * s +
                (1. - r) * tau * s_95 / 3. * (1. - std::exp(-3. * s / s_95)));
      const double work = soil.account("friction work") - before;
      EXPECT_NEAR(work, expected, 1e-3 * expected) << s;
      EXPECT_EQ(slip.slipped_areas(2, soil.grid.communicator())[1], area);
    }
}



// Impulses survive a checkpoint by name of the facet, on any rank.
TEST(Contact, ImpulsesSurviveACheckpoint)
{
  contact_test::Step<2> soil("set Friction coefficient = 0.3",
                             Point<2>(1., -2.));
  std::vector<double>   rows;
  for (const auto &of_rank :
       MPI::all_gather(soil.grid.communicator(), soil.contact.save()))
    rows.insert(rows.end(), of_rank.begin(), of_rank.end());
  ContactImpulses<2> impulses;
  impulses.restore(rows);
  EXPECT_EQ(impulses.rows(), rows);
  impulses.update(keys_of(soil.facets.owned()));
  ASSERT_EQ(impulses.all().size(), soil.contact.impulses().size());
  for (unsigned int f = 0; f < impulses.all().size(); ++f)
    {
      const ContactImpulse<2> &saved = soil.contact.impulses()[f];
      EXPECT_EQ(impulses[f].normal, saved.normal);
      EXPECT_EQ(impulses[f].tangential, saved.tangential);
      EXPECT_EQ(impulses[f].effective_mass, saved.effective_mass);
      EXPECT_EQ(impulses[f].mean_normal, saved.mean_normal);
    }
  // Rows of facets that do not exist have no effect.
  for (std::size_t i = 2; i < rows.size(); i += 10)
    rows[i] += 1.; // the number of the obstacle
  impulses.restore(rows);
  for (const ContactImpulse<2> &impulse : impulses.all())
    EXPECT_FALSE(impulse.acts());
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// Sums of the soil over columns, and their envelope over time.

#include <talus/maps/column_sums.h>
#include <talus/maps/envelope.h>

#include "ranks_setup.h"
#include "suites.h"

namespace column_sums_test
{
  TALUS_ALSO_ON_RANKS(ColumnSums, 2, 3);

  /// Columns of 0.5 m over the slab.
  template <int dim>
  std::shared_ptr<LatticeColumns<dim>>
  columns_over_slab()
  {
    std::array<typename LatticeColumns<dim>::Axis, dim - 1> axes;
    axes[0]       = {0., 0.5, 12};
    axes[dim - 2] = {0., 0.5, dim == 2 ? 12u : 4u};
    return std::make_shared<LatticeColumns<dim>>(axes);
  }



  template <int dim>
  void
  expect_totals()
  {
    Core<dim> core(slab<dim>());
    core.constants.box_shape = core.transfer.box_shape();
    add_shared(core, 100, 2, [&]() { return core.place(); });
    core.sort();
    ColumnSums<dim> sums(columns_over_slab<dim>());
    // The second time nothing is left of the first sums.
    for (unsigned int i = 0; i < 2; ++i)
      sums.sum_soil(core);
    Tensor<1, dim> force, forces;
    for (unsigned int k = 0; k < 3; ++k)
      {
        Box<dim> box = core.grid.cells()[k].box();
        force[0]     = k + 1.;
        sums.add_bed_force(force, box);
        forces += force;
      }
    double         volume = 0, mass = 0;
    Tensor<1, dim> momentum;
    for (unsigned int p = 0; p < core.points.size(); ++p)
      {
        const double m = core.points.data(core.points.mass)[p];
        volume += core.volume(p);
        mass += m;
        momentum += m * core.get(core.points.velocity, p);
      }
    const MPI_Comm communicator = core.grid.communicator();
    volume                      = MPI::sum(volume, communicator);
    mass                        = MPI::sum(mass, communicator);
    momentum                    = MPI::sum(momentum, communicator);
    forces                      = MPI::sum(forces, communicator);
    sums.sum_over_ranks(communicator);
    if (MPI::this_mpi_process(communicator) > 0)
      return;
    ColumnSum<dim>         total;
    std::set<unsigned int> with_soil(sums.with_soil().begin(),
                                     sums.with_soil().end());
    EXPECT_EQ(with_soil.size(), sums.with_soil().size());
    for (unsigned int column = 0; column < sums.columns().size(); ++column)
      {
        EXPECT_EQ(sums[column].mass > 0, with_soil.count(column) > 0);
        total.volume += sums[column].volume;
        total.mass += sums[column].mass;
        total.momentum += sums[column].momentum;
        total.bed_force += sums[column].bed_force;
      }
    EXPECT_NEAR(total.volume, volume, 1e-12 * volume);
    EXPECT_NEAR(total.mass, mass, 1e-12 * mass);
    EXPECT_LT((total.momentum - momentum).norm(), 1e-12 * mass);
    EXPECT_LT((total.bed_force - forces).norm(), 1e-12 * forces.norm());
  }
} // namespace column_sums_test



TEST(ColumnSums, NothingIsLostOnAnyNumberOfRanks)
{
  column_sums_test::expect_totals<2>();
  column_sums_test::expect_totals<3>();
}



namespace column_sums_test
{
  /// Points one by one in a mesh of 4 x 4 m, and columns of 1 m.
  struct Soil : Core<2>
  {
    Soil()
      : Core<2>(mesh("0, 0", "4, 4"), {}, MPI_COMM_SELF)
      , sums(std::make_shared<LatticeColumns<2>>(
          std::array<LatticeColumns<2>::Axis, 1>{{{0., 1., 4}}}))
    {
      constants.box_shape = transfer.box_shape();
    }

    /// A box of 0.8 m x @p height m at rest or with a velocity, 2000 kg/m^3.
    unsigned int
    add_box(const Point<2> &x, const double height, const Vector &velocity)
    {
      const unsigned int p = add(x, Point<2>(0.8, height));
      resize(p, height);
      set(points.velocity, p, velocity);
      return p;
    }

    void
    resize(const unsigned int p, const double height)
    {
      points.data(points.edges, 3)[p] = height; // y of edge 1
      points.data(points.mass)[p]     = 2000. * 0.8 * height;
    }

    ColumnSums<2> sums;
  };
} // namespace column_sums_test



// The upper box, of which a quarter is in the first column, is twice as fast.
TEST(ColumnSums, DepthMeansOfTwoBoxes)
{
  using namespace column_sums_test;
  Soil soil;
  soil.add_box({1.5, 0.5}, 0.5, Point<2>(3., 0.));
  soil.add_box({1.2, 1.5}, 0.25, Point<2>(6., 8.));
  soil.sort();
  soil.sums.sum_soil(soil);
  ASSERT_EQ(soil.sums.with_soil().size(), 2u);
  EXPECT_NEAR(soil.sums.thickness(0), 0.05, 1e-15);
  EXPECT_NEAR(soil.sums.thickness(1), 0.4 + 0.15, 1e-15);
  EXPECT_NEAR(soil.sums.mass(1), 2000. * 0.55, 1e-10);
  EXPECT_NEAR(soil.sums.density(1), 2000., 1e-10);
  EXPECT_LT((soil.sums.velocity(0) - Point<2>(6., 8.)).norm(), 1e-14);
  const Tensor<1, 2> mean =
    (0.4 * Point<2>(3., 0.) + 0.15 * Point<2>(6., 8.)) / 0.55;
  EXPECT_LT((soil.sums.velocity(1) - mean).norm(), 1e-14);
  EXPECT_NEAR(soil.sums.momentum_flux(0), 2000. * 0.05 * 100., 1e-9);
  // Twice the force over the columns 1 and 2, half of the force over each.
  soil.sums.add_bed_force(Point<2>(-30., 40.),
                          {Point<2>(1., 0.), Point<2>(3., 1.)});
  EXPECT_NEAR(soil.sums.bed_shear_stress(1), 25., 1e-13);
  EXPECT_NEAR(soil.sums.bed_shear_stress(2), 25., 1e-13);
  EXPECT_EQ(soil.sums.bed_shear_stress(0), 0.);
  // A force alone is no soil.
  EXPECT_EQ(soil.sums.with_soil().size(), 2u);
}



TEST(ColumnSums, StrengthIsTheMeanByVolume)
{
  using namespace column_sums_test;
  Soil         soil;
  Materials<2> materials({{"weak", "von Mises"}, {"strong", "von Mises"}});
  dealii::ParameterAcceptor::declare_all_parameters();
  dealii::ParameterAcceptor::prm.parse_input_from_string(
    in_section("Materials",
               in_section("weak", "set Undrained shear strength = 1000") +
                 in_section("strong", "set Undrained shear strength = 4000")));
  dealii::ParameterAcceptor::parse_all_parameters();
  materials.assign({"lower", "upper"}, {"weak", "strong"});
  materials.add_columns(soil.points);
  soil.add_box({1.5, 0.5}, 0.5, {});
  const unsigned int p                  = soil.add_box({1.5, 1.5}, 0.25, {});
  soil.points.data(soil.points.body)[p] = 1.;
  materials.of_body(0).initialize(soil.points, 0, p);
  materials.of_body(1).initialize(soil.points, p, p + 1);
  soil.sort();
  soil.sums.sum_soil(soil, &materials);
  EXPECT_NEAR(soil.sums.strength(1), (2. * 1000. + 4000.) / 3., 1e-9);
}



// A box grows, becomes faster, and leaves its column.
TEST(Envelope, MaximaArrivalsAndErosion)
{
  using namespace column_sums_test;
  Soil               soil;
  const unsigned int p = soil.add_box({1.5, 0.5}, 0.25, Point<2>(9., 0.));
  Envelope<2>        envelope(4, {0.3, {0.1, 0.4, 0.9}, {2., 0.}});
  const auto         sample = [&](const double t) {
    soil.sort();
    soil.sums.sum_soil(soil);
    soil.sums.add_bed_force(Point<2>(t * 7., 0.),
                            {Point<2>(1., 0.), Point<2>(2., 1.)});
    envelope.add(soil.sums, t);
  };
  soil.sort();
  soil.sums.sum_soil(soil);
  envelope.start(soil.sums);
  sample(0.); // 0.2 m: too thin for the speed to count
  soil.resize(p, 0.75);
  soil.set(soil.points.velocity, p, Point<2>(3., 4.));
  sample(1.);
  sample(2.); // the same maxima again, but for the shear stress
  soil.points.data(soil.points.position)[p] = 2.5;
  soil.set(soil.points.velocity, p, Point<2>(1., 0.));
  sample(3.);

  EXPECT_EQ(envelope.reached(), (std::vector<unsigned int>{1, 2}));
  const ColumnHistory &left = envelope[1], &now = envelope[2];
  EXPECT_NEAR(left.thickness_at_start, 0.2, 1e-15);
  EXPECT_EQ(left.thickness, 0.);
  EXPECT_EQ(left.mass, 0.);
  EXPECT_NEAR(left.max_thickness.value, 0.6, 1e-15);
  EXPECT_EQ(left.max_thickness.time, 1.);
  EXPECT_NEAR(left.speed.value, 5., 1e-14);
  EXPECT_EQ(left.speed.time, 1.);
  EXPECT_NEAR(left.momentum_flux.value, 2000. * 0.6 * 25., 1e-9);
  EXPECT_NEAR(left.impact_pressure.value, 0.5 * 2. * 2000. * 25., 1e-9);
  EXPECT_NEAR(left.bed_shear_stress.value, 14., 1e-13);
  EXPECT_EQ(left.bed_shear_stress.time, 2.);
  EXPECT_EQ(left.arrival[0], 0.);
  EXPECT_EQ(left.arrival[1], 1.);
  EXPECT_TRUE(std::isnan(left.arrival[2]));
  EXPECT_NEAR(now.thickness, 0.6, 1e-15);
  EXPECT_EQ(now.arrival[1], 3.);
  EXPECT_NEAR(now.mass, 1200., 1e-10);
  for (const HistoryField &field : history_fields({0.1}))
    if (field.name == "erosion")
      {
        EXPECT_NEAR(field.value(left), 0.2, 1e-15);
        EXPECT_NEAR(field.value(now), -0.6, 1e-15);
      }
}

// SPDX-License-Identifier: LGPL-2.1-or-later
// What all laws share: batches, factory, parameters.

#include <talus/base/errors.h>
#include <talus/materials/factory.h>

#include "specimen.h"

using namespace talus;

namespace
{
  /// All columns of 11 points after a step: in one batch, and one by one.
  template <int dim>
  void
  check_batch(const std::string &name)
  {
    constexpr unsigned int n = 11;
    Specimen<dim>          batch(name, paper.parameters_of(name), n);
    Specimen<dim>          single(name, paper.parameters_of(name), n);
    for (Specimen<dim> *soil : {&batch, &single})
      {
        std::mt19937 random(2);
        for (unsigned int p = 0; p < n; ++p)
          {
            soil->set_F(add(identity<dim, double>(),
                            random_matrix<dim>(random, 0.2),
                            1.),
                        p);
            soil->set_increment(random_matrix<dim>(random,
                                                   p % 3 == 0 ? 0.05 : 5e-3),
                                p);
            for (unsigned int c = 0; c < n_stress_components<dim>; ++c)
              soil->points.data(soil->points.stress, c)[p] =
                random_matrix<2>(random, 2000.)[0][0];
          }
      }
    batch.law->update_stress(batch.points, batch.workspace, 0, n, batch.dt);
    for (unsigned int p = 0; p < n; ++p)
      single.law->update_stress(
        single.points, single.workspace, p, p + 1, single.dt);

    double modulus[n + Points<dim>::n_spare];
    batch.law->wave_modulus(batch.points, 0, n, modulus);
    for (const Column &column : batch.points.columns())
      for (unsigned int c = 0; c < column.n_components; ++c)
        for (unsigned int p = 0; p < n; ++p)
          {
            const double expected = single.points.data(column.first, c)[p];
            // Of the size of the moduli, which the stress is a difference of.
            const double scale =
              column.unit == "Pa" ? paper.bulk : std::abs(expected) + 1.;
            EXPECT_NEAR(batch.points.data(column.first, c)[p],
                        expected,
                        1e-14 * scale)
              << name << ", " << column.name << ", point " << p;
          }
    for (unsigned int p = 0; p < n; ++p)
      {
        double of_point;
        single.law->wave_modulus(single.points, p, p + 1, &of_point);
        EXPECT_NEAR(modulus[p], of_point, 1e-14 * of_point) << name;
      }
  }



  template <typename Call>
  std::string
  sentence_of_failed(const Call &call)
  {
    try
      {
        call();
      }
    catch (const ExcUser &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST(Materials, BatchEqualsPointByPoint)
{
  for (const std::string &name : material_names<2>())
    {
      check_batch<2>(name);
      check_batch<3>(name);
    }
}



TEST(Materials, FactoryKnowsItsLaws)
{
  for (const std::string &name : material_names<3>())
    EXPECT_NE(make_law<3>(name, ""), nullptr);
  const std::string message =
    sentence_of_failed([] { make_material<2>("jelly", "/Materials/clay"); });
  for (const std::string part :
       {"jelly", "/Materials/clay", "linear elastic, von Mises, Mohr-Coulomb"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
}



// That a good one runs is shown by tests/cases/own_law.py.
TEST(Materials, AddedLawMustHaveANameOfItsOwn)
{
  for (const std::string name : {"von Mises", "", "a|b", "a, b", " a", "a#b"})
    {
      const std::string message = sentence_of_failed([&] {
        add_law<2>({name, false, {}});
      });
      EXPECT_NE(message.find("'" + name + "'"), std::string::npos) << message;
    }
}



// What messages say of the laws is what the laws say of themselves.
TEST(Materials, LawsWithStrengthAreNamed)
{
  const std::string named = names_of_laws_with_strength<3>();
  EXPECT_EQ(named, names_of_laws_with_strength<2>());
  EXPECT_EQ(named.find("'von Mises', 'Mohr-Coulomb'"), 0u) << named;
  EXPECT_NE(named.find(" or '"), std::string::npos) << named;
  for (const std::string &name : material_names<3>())
    EXPECT_EQ(make_law<3>(name, "")->has_strength(),
              named.find("'" + name + "'") != std::string::npos)
      << name;
}



TEST(Materials, ContradictionsAreRefused)
{
  EXPECT_NE(sentence_of_failed([] {
              make_law<2>("von Mises",
                          "set Young's modulus = 1e5\n"
                          "set Poisson's ratio = 0.25\n"
                          "set Hardening modulus = -1.2e5");
            }).find("more than -118800 Pa"),
            std::string::npos);
  EXPECT_NE(sentence_of_failed([] {
              make_law<2>("Hencky", "set Poisson's ratio = 0.5");
            }).find("0.49"),
            std::string::npos);
  EXPECT_NE(sentence_of_failed([] {
              make_law<2>("von Mises",
                          "set Residual undrained shear strength = 2501");
            }).find("must not exceed"),
            std::string::npos);
  EXPECT_THROW(make_law<2>("Hencky", "set Submerged density = heavy"),
               dealii::ExceptionBase);
}



TEST(Materials, CommonParameters)
{
  const auto plain = make_law<2>("linear elastic", "set Density = 1600");
  EXPECT_EQ(plain->submerged_density(), 1600.);
  EXPECT_FALSE(plain->uses_bbar());
  const auto clay =
    make_law<2>("linear elastic",
                "set Submerged density = 600\nset Poisson's ratio = 0.49");
  EXPECT_EQ(clay->density(), 1000.);
  EXPECT_EQ(clay->submerged_density(), 600.);
  EXPECT_TRUE(clay->uses_bbar());
  EXPECT_TRUE(make_law<2>("von Mises", "")->uses_bbar());
  EXPECT_FALSE(make_law<2>("von Mises", "set Cell mean = off")->uses_bbar());
}



TEST(Materials, PointsTurnedInsideOutAreReported)
{
  for (const std::string &name : material_names<2>())
    {
      Specimen<2> soil(name, paper.parameters_of(name), 9);
      for (unsigned int p = 0; p < 9; ++p)
        soil.set_increment(Matrix<2, double>{}, p);
      soil.set_increment({{{{{-1.5, 0.}}, {{0., 0.}}}}}, 4);
      EXPECT_THROW(
        soil.law->update_stress(soil.points, soil.workspace, 0, 9, soil.dt),
        ExcPoint);
    }
}



namespace
{
  /// Message for a point turned inside out, of a law with Young's modulus
  /// @p modulus, Pa, below 10 m of soil of 1500 kg/m^3, submerged 500 kg/m^3.
  /// A third point lies 1000 m higher on the slope.
  std::string
  message_on_inversion(const std::string &law, const double modulus)
  {
    Specimen<2> soil(law,
                     text("set Young's modulus = ",
                          modulus,
                          "\nset Poisson's ratio = 0.25\nset Density = 1500"
                          "\nset Submerged density = 500"),
                     3);
    for (unsigned int p = 0; p < 3; ++p)
      {
        soil.points.data(soil.points.mass)[p] =
          1500. * soil.points.data(soil.points.reference_volume)[p];
        soil.points.data(soil.points.position, 0)[p] = (p == 2 ? 2e3 : 0.);
        soil.points.data(soil.points.position, 1)[p] =
          (p == 2 ? 1e3 : 3. + 10. * p);
        soil.set_increment({{{{{p == 0 ? -1.5 : 0., 0.}}, {{0., 0.}}}}}, p);
      }
    try
      {
        soil.law->update_stress(soil.points, soil.workspace, 0, 3, soil.dt);
      }
    catch (const ExcPoint &error)
      {
        std::ostringstream out;
        error.print_info(out);
        return out.str();
      }
    return "";
  }
} // namespace



// rho g H = 49050 Pa: soil with a shear modulus of 400 kPa bears the weight,
// soil with 400 Pa, as if the entry were in kPa, does not. Both causes are
// named, the likelier cause first.
TEST(Materials, CauseOfInversionFollowsFromTheStiffness)
{
  for (const std::string law : {"linear elastic", "neo-Hookean"})
    for (const double modulus : {1e6, 1e3})
      {
        const std::string said  = message_on_inversion(law, modulus);
        const auto        steps = said.find("'Time step/CFL number'");
        const auto        units = said.find("in Pa");
        ASSERT_NE(steps, std::string::npos) << said;
        ASSERT_NE(units, std::string::npos) << said;
        EXPECT_EQ(units < steps, modulus == 1e3) << said;
        EXPECT_NE(said.find(text("shear modulus is ", 0.4 * modulus, " Pa")),
                  std::string::npos)
          << said;
        EXPECT_NE(said.find("per area, 49050 Pa"), std::string::npos) << said;
      }
}
